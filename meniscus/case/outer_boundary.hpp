#pragma once

#include <string_view>
#include <vector>

#include "meniscus/case/case.hpp"

namespace meniscus {

/// The names of a shape's patches; empty for a surface from a file.
[[nodiscard]] std::vector<std::string_view> patch_names(DomainCase::Shape shape);
/// The face tags (mesh/shapes.hpp) a patch name stands for; empty when it is not one of the shape.
[[nodiscard]] std::vector<int> shape_tags(DomainCase::Shape shape, std::string_view name);

/// The triangulated outer boundary with a condition on every patch. Throws InvalidInput naming the
/// line when a surface file is unfit, or when its tags and the [[domain.patch]] do not match. So it
/// does when a scalar has no value where liquid enters.
[[nodiscard]] OuterBoundary build_boundary(const Case& c, const WarningListener& warn);

}  // namespace meniscus
