#include "meniscus/linear/graph_partition.hpp"

#include <algorithm>
#include <span>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/petsc_objects.hpp"

// Weak: present when PETSc is linked with Scotch.
extern "C" void SCOTCH_randomReset() __attribute__((weak));

namespace meniscus::linear {
namespace {

using Partitioning = Owned<MatPartitioning, MatPartitioningDestroy>;
using IndexSet = Owned<IS, ISDestroy>;

/// A copy of the values that PETSc will free.
PetscInt* petsc_copy(std::span<const std::int32_t> values) {
  PetscInt* copy = nullptr;
  petsc_check(PetscMalloc1(std::max<std::size_t>(values.size(), 1), &copy), "PetscMalloc1");
  std::ranges::copy(values, copy);
  return copy;
}

Matrix adjacency(const WeightedGraph& graph) {
  Matrix matrix;
  petsc_check(MatCreateMPIAdj(PETSC_COMM_SELF, graph.num_vertices(), graph.num_vertices(),
                              petsc_copy(graph.row_start), petsc_copy(graph.neighbours),
                              petsc_copy(graph.edge_weights), matrix.out()),
              "MatCreateMPIAdj");
  return matrix;
}

}  // namespace

Partitioner best_partitioner() {
  start_petsc();
  PetscBool has = PETSC_FALSE;
  petsc_check(PetscHasExternalPackage("ptscotch", &has), "PetscHasExternalPackage");
  return has == PETSC_TRUE ? Partitioner::ptscotch : Partitioner::even;
}

std::vector<std::int32_t> partition(const WeightedGraph& graph, int num_parts,
                                    Partitioner partitioner) {
  MENISCUS_ASSERT(graph.row_start.size() == graph.vertex_weights.size() + 1 &&
                      graph.neighbours.size() == graph.edge_weights.size(),
                  "{} vertices, {} rows, {} edges, {} weights", graph.num_vertices(),
                  graph.row_start.size(), graph.neighbours.size(), graph.edge_weights.size());
  start_petsc();
  const bool is_scotch = partitioner == Partitioner::ptscotch;
  // Scotch's random numbers depend on earlier calls, and a resumed run has made fewer.
  if (is_scotch && SCOTCH_randomReset != nullptr) SCOTCH_randomReset();
  const Matrix matrix = adjacency(graph);
  Partitioning partitioning;
  petsc_check(MatPartitioningCreate(PETSC_COMM_SELF, partitioning.out()), "MatPartitioningCreate");
  MatPartitioning handle = partitioning.get();
  petsc_check(MatPartitioningSetAdjacency(handle, matrix.get()), "MatPartitioningSetAdjacency");
  petsc_check(
      MatPartitioningSetType(handle, is_scotch ? MATPARTITIONINGPTSCOTCH : MATPARTITIONINGAVERAGE),
      "MatPartitioningSetType");
  if (is_scotch) {
    petsc_check(MatPartitioningSetVertexWeights(handle, petsc_copy(graph.vertex_weights)),
                "MatPartitioningSetVertexWeights");
    petsc_check(MatPartitioningSetUseEdgeWeights(handle, PETSC_TRUE),
                "MatPartitioningSetUseEdgeWeights");
  }
  petsc_check(MatPartitioningSetNParts(handle, num_parts), "MatPartitioningSetNParts");
  IndexSet parts;
  petsc_check(MatPartitioningApply(handle, parts.out()), "MatPartitioningApply");
  const PetscInt* values = nullptr;
  petsc_check(ISGetIndices(parts.get(), &values), "ISGetIndices");
  std::vector<std::int32_t> result(values, values + graph.num_vertices());
  petsc_check(ISRestoreIndices(parts.get(), &values), "ISRestoreIndices");
  return result;
}

}  // namespace meniscus::linear
