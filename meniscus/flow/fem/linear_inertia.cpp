#include "meniscus/flow/fem/linear_inertia.hpp"

namespace meniscus::fem {

LinearInertia::LinearInertia(const StokesProblem& problem, const LinearElement::Point& point,
                             CellId c, const Field<NodeId, Vec3>* convecting) {
  const InertiaTerms& terms = *problem.inertia;
  rate_ = terms.density[c] / terms.duration;
  // ∫φ_iφ_j
  const Eigen::Matrix4d products =
      point.weight / 20.0 * (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity());
  mass_ = rate_ * products;
  const auto nodes = problem.space.velocity.of(c);
  for (std::size_t i = 0; i < 4; ++i)
    before_.col(static_cast<Eigen::Index>(i)) = terms.before[NodeId{nodes[i]}];
  if (convecting != nullptr) {
    Eigen::Matrix<double, 3, 4> a;
    for (std::size_t i = 0; i < 4; ++i)
      a.col(static_cast<Eigen::Index>(i)) =
          (*convecting)[NodeId{nodes[i]}] - terms.mesh_velocity[NodeId{nodes[i]}];
    const Eigen::Matrix4d slopes = terms.density[c] * a.transpose() * point.gradient;
    convection_.noalias() = products * slopes;
    mean_convection_ = slopes.colwise().mean();
  }
}

Eigen::Matrix<double, 3, 4> LinearInertia::momentum_of(const Eigen::Matrix<double, 3, 4>& v) const {
  return (v - before_) * mass_ + v * convection_.transpose();
}

Vec3 LinearInertia::mean_of(const Eigen::Matrix<double, 3, 4>& v) const {
  return 0.25 * rate_ * (v - before_).rowwise().sum() + v * mean_convection_.transpose();
}

InertialMatrices::InertialMatrices(const StokesProblem& problem, const LinearElement::Point& point,
                                   CellId c, const Field<NodeId, Vec3>* convecting)
    : CellMatrices(problem, {&point, 1}, c),
      inertia_(problem, point, c, convecting),
      momentum_(inertia_.momentum()) {
  const double tau = stabilisation_parameter(problem, c, point.weight, problem.viscosity[c]);
  slope_ = tau * point.weight * point.gradient;
}

Mat3 InertialMatrices::viscous_block(std::size_t i, std::size_t j) const {
  Mat3 block = CellMatrices::viscous_block(i, j);
  block.diagonal().array() += momentum_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return block;
}

double InertialMatrices::laplacian(std::size_t i, std::size_t j) const {
  return CellMatrices::laplacian(i, j) +
         inertia_.mass()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

Vec3 InertialMatrices::lower_left_of(std::size_t k, std::size_t j) const {
  return divergence_of(k, j) - inertia_.mean(j) * slope_.col(static_cast<Eigen::Index>(k));
}

void remember_divergence(StokesProblem& problem) {
  InertiaTerms& terms = *problem.inertia;
  NodePositions before = problem.positions;
  for (const NodeId i : before.x.ids()) before.x[i] -= terms.duration * terms.mesh_velocity[i];
  LinearElement now(problem.space, problem.positions), then(problem.space, before);
  const StokesState state{terms.before, std::vector<double>(problem.space.pressure.vertex.size())};
  std::vector<double> remembered, volume;  // of each region
  terms.remembered_divergence = CellField<double>(problem.mesh.num_cells());
  CellField<double> volumes(problem.mesh.num_cells());
  for (const CellId c : problem.mesh.cells.ids()) {
    volumes[c] = now.points(c).front().weight;
    const LinearElement::Point& point = then.points(c).front();
    const double share = stabilisation_parameter(problem, c, volumes[c], problem.viscosity[c]) *
                         terms.density[c] / terms.duration;
    terms.remembered_divergence[c] =
        share * point.weight *
        CellState<LinearElement>(problem.space, state, c).velocity_gradient(point).trace();
    const auto region = static_cast<std::size_t>(problem.mesh.region[c].value);
    if (region >= volume.size()) volume.resize(region + 1), remembered.resize(region + 1);
    remembered[region] += terms.remembered_divergence[c];
    volume[region] += volumes[c];
  }
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto region = static_cast<std::size_t>(problem.mesh.region[c].value);
    terms.remembered_divergence[c] -= remembered[region] / volume[region] * volumes[c];
  }
}

}  // namespace meniscus::fem
