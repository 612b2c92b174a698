#include "meniscus/linear/saddle_solver.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/core/processor_time.hpp"
#include "meniscus/linear/collective.hpp"
#include "meniscus/linear/petsc_matrix.hpp"
#include "meniscus/linear/preconditioners.hpp"
#include "meniscus/linear/saddle_options.hpp"
#include "meniscus/linear/vector_arrays.hpp"

namespace meniscus::linear {
namespace {

using Apply = std::function<void(Vec, Vec)>;

// Ranks that meet the same error are at most one collective call apart.
constexpr std::chrono::seconds kPatience{10};

PetscErrorCode apply_shell(PC pc, Vec r, Vec z) {
  void* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(pc, &context);
  if (code != 0) return code;
  try {  // no exception may pass through PETSc's frames
    (*static_cast<Apply*>(context))(r, z);
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
  return 0;
}

double mean_of(Communicator communicator, std::span<const double> values) {
  return sum(communicator, std::accumulate(values.begin(), values.end(), 0.0)) /
         double(sum(communicator, static_cast<std::int64_t>(values.size())));
}

/// The right-hand side with its pressure part times `continuity_sign`. Where the constant pressure
/// is a null vector, the mean of that part is removed to make the system consistent.
std::vector<double> consistent_right_hand_side(Communicator communicator,
                                               const SaddleSystem& system,
                                               std::span<const double> given,
                                               double continuity_sign) {
  std::vector<double> values(given.begin(), given.end());
  const auto pressures = std::span(values).subspan(std::size_t(system.num_velocities()));
  const double mean = system.constant_pressure_is_null ? mean_of(communicator, pressures) : 0.0;
  for (double& value : pressures) value = continuity_sign * (value - mean);
  return values;
}

/// Whether a word is an option's name: a number may begin with a minus sign as well.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(word[1])) != 0;
}

/// Warns of words that belong to no option, which PETSc ignores.
void check_words(const std::string& given) {
  std::istringstream words(given);
  bool may_be_value = false;
  for (std::string word; words >> word;) {
    if (!is_option(word) && !may_be_value)
      reject_input("solver options \"{}\": \"{}\" belongs to no option (-name value …)", given,
                   word);
    may_be_value = is_option(word);
  }
}

/// Warns of options that no solver has read, which are likely misspelt.
void warn_of_unused(PetscOptions table, const std::string& given) {
  std::istringstream words(given);
  for (std::string word; words >> word;) {
    if (!is_option(word)) continue;
    PetscBool is_used = PETSC_TRUE;
    petsc_check(PetscOptionsUsed(table, word.c_str() + 1, &is_used), "PetscOptionsUsed");
    if (!is_used) log::warning("the solver option {} was not used", word);
  }
}

/// Velocities and pressures of one rank, as a system has them.
struct WholeVector {
  explicit WholeVector(const SaddleSystem& system)
      : values(static_cast<std::size_t>(system.size()), 0.0),
        num_velocities(static_cast<std::size_t>(system.num_velocities())) {}
  [[nodiscard]] std::span<double> velocities() { return std::span(values).first(num_velocities); }
  [[nodiscard]] std::span<double> pressures() { return std::span(values).subspan(num_velocities); }
  std::vector<double> values;
  std::size_t num_velocities;
};

/// The product with weighted rows, as a Krylov method sees it, and its preconditioner.
class WeightedOperator {
 public:
  WeightedOperator(Communicator communicator, const SaddleSystem& system)
      : weights_(system.residual_weights),
        action_([this, &system](std::span<const double> x, std::span<double> result) {
          system.products.whole(x, result);
          weigh(result);
        }),
        matrix_(shell_matrix(mpi_communicator(communicator), action_, system.size())),
        unweighted_(zero_vector(mpi_communicator(communicator), system.size())) {
    MENISCUS_ASSERT(weights_.size() == std::size_t(system.size()), "{} weights of {} rows",
                    weights_.size(), system.size());
    if (system.constant_pressure_is_null)
      attach_constant_pressure(communicator, matrix_.get(), system.num_velocities(),
                               system.num_pressures(), weights_);
  }
  WeightedOperator(const WeightedOperator&) = delete;
  WeightedOperator& operator=(const WeightedOperator&) = delete;
  ~WeightedOperator() = default;

  [[nodiscard]] Mat matrix() const { return matrix_.get(); }
  void weigh(std::span<double> rows) const {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] *= weights_[i];
  }
  /// `apply` on what r was without weights.
  void precondition(const std::function<void(Vec, Vec)>& apply, Vec r, Vec z) const {
    with_arrays(r, unweighted_.get(), [this](const double* from, double* to) {
      for (std::size_t i = 0; i < weights_.size(); ++i) to[i] = from[i] / weights_[i];
    });
    apply(unweighted_.get(), z);
  }

 private:
  std::span<const double> weights_;
  LinearOperator action_;
  Matrix matrix_;
  Vector unweighted_;
};

void remove_mean(Communicator communicator, std::span<double> values) {
  const double mean = mean_of(communicator, values);
  for (double& value : values) value -= mean;
}

}  // namespace

class SaddleSolver::Implementation {
 public:
  Implementation(Communicator communicator, SaddleOptions options)
      : communicator_(communicator), options_(std::move(options)) {
    start_petsc();
    petsc_check(PetscOptionsCreate(table_.out()), "PetscOptionsCreate");
    petsc_check(
        PetscOptionsInsertString(
            table_.get(),
            default_options(options_.method, options_.multigrid_by_degree, has_hypre()).c_str()),
        "PetscOptionsInsertString");
    check_words(options_.petsc_options);
    if (PetscOptionsInsertString(table_.get(), options_.petsc_options.c_str()) != 0)
      reject_input("solver options \"{}\" are not what PETSc can read", options_.petsc_options);
  }

  LinearReport solve(const SaddleSystem& system, std::span<const double> right_hand_side,
                     std::span<double> solution, double rtol, Preconditioner preconditioner) {
    MENISCUS_ASSERT(right_hand_side.size() == std::size_t(system.size()) &&
                        solution.size() == right_hand_side.size(),
                    "{} unknowns, {} and {} given", system.size(), right_hand_side.size(),
                    solution.size());
    MENISCUS_ASSERT(rtol > 0.0, "{}", rtol);
    LinearReport report;
    const OptionScope scope(table_.get());
    try {
      if (preconditioner == Preconditioner::fresh) drop_preconditioner();
      const double start = processor_seconds();
      prepare(system);
      report.setup_seconds = processor_seconds() - start;
      iterate(system, right_hand_side, solution, rtol, report);
      report.solve_seconds = processor_seconds() - start - report.setup_seconds;
      if (!std::exchange(is_checked_, true)) warn_of_unused(table_.get(), options_.petsc_options);
    } catch (const PetscFailure& failure) {
      abort_if_alone(failure);
      report.converged = false;
      report.reason = failure.what();
      drop_preconditioner();
    }
    release();
    return report;
  }

  void keep(const SaddleSystem& system) {
    const OptionScope scope(table_.get());
    drop_preconditioner();
    try {
      prepare(system);
    } catch (const PetscFailure& failure) {  // the solve that needs it will report why
      abort_if_alone(failure);
      drop_preconditioner();
    }
    release();
  }

 private:
  [[nodiscard]] MPI_Comm comm() const { return mpi_communicator(communicator_); }

  /// Ends all ranks if only some ranks met an error: the others would wait for ever.
  void abort_if_alone(const PetscFailure& failure) const {
    if (all_arrive(communicator_, kPatience)) return;
    log::write(log::Level::error,
               fmt::format("rank {} alone: {}", communicator_.rank(), failure.what()));
    abort(communicator_, 1);
  }

  void drop_preconditioner() {
    multigrid_.reset();
    slow_pressures_.reset();
    pressure_laplacian_.reset();
    factorization_.reset();
    nested_ = {};
    outer_ = {};
  }

  /// Makes the operator, and those parts of the preconditioner that were not kept.
  void prepare(const SaddleSystem& system) {
    if (std::exchange(size_, system.size()) != system.size()) outer_ = {};
    const bool is_paper = options_.method == SaddleMethod::paper_gmres;
    if (system.has_products()) {
      MENISCUS_ASSERT(!is_paper && options_.method != SaddleMethod::mumps, "{} needs matrices",
                      name(options_.method));
      product_ = shell_matrix(comm(), system.products.whole, system.size());
      operator_ = product_.get();
    } else if (is_paper) {
      merged_ = merged_matrix(comm(), system, -1.0, 0.0);
      operator_ = merged_.handle.get();
      scaling_.emplace(operator_);
      apply_ = [this](Vec r, Vec z) { scaling_->apply(r, z); };
    } else {
      const bool is_minres = options_.method == SaddleMethod::minres;
      const SaddleSystem taken = is_minres ? system.symmetric_part() : system;
      if (!take_values(comm(), taken, nested_)) nested_ = nested_operator(comm(), taken);
      operator_ = nested_.nest.get();
    }
    if (system.constant_pressure_is_null)
      attach_constant_pressure(communicator_, operator_, system.num_velocities(),
                               system.num_pressures());
    if (options_.method == SaddleMethod::mumps) {
      if (!factorization_ || factorization_->size() != system.size())
        factorization_ = std::make_unique<Factorization>(communicator_, system);
      apply_ = [this](Vec r, Vec z) { factorization_->apply(r, z); };
    } else if (!is_paper) {
      if (!multigrid_ || 3 * multigrid_->num_nodes() != system.num_velocities()) {
        multigrid_ = make_multigrid(system);
        slow_pressures_ = make_slow_pressures(system);
      }
      if (system.mass_diagonal.empty())
        pressure_laplacian_.reset();
      else if (!pressure_laplacian_ || pressure_laplacian_->size() != system.num_pressures())
        pressure_laplacian_ = std::make_unique<PressureLaplacian>(communicator_, system);
      using Shape = BlockPreconditioner::Shape;
      block_.emplace(
          communicator_,
          options_.method == SaddleMethod::minres ? Shape::diagonal : Shape::upper_triangular,
          system, *multigrid_, nested_.B.get(), pressure_laplacian_.get(),
          slow_pressures_ ? &*slow_pressures_ : nullptr);
      apply_ = [this](Vec r, Vec z) { block_->apply(r, z); };
    }
    weigh_rows(system);
  }

  void weigh_rows(const SaddleSystem& system) {
    if (system.residual_weights.empty() || !system.has_products() ||
        options_.method != SaddleMethod::block)
      return;
    weighted_.emplace(communicator_, system);
    apply_ = [this, apply = std::move(apply_)](Vec r, Vec z) {
      weighted_->precondition(apply, r, z);
    };
  }
  /// What the Krylov method iterates with.
  [[nodiscard]] Mat iterated() const { return weighted_ ? weighted_->matrix() : operator_; }

  [[nodiscard]] std::unique_ptr<VelocityPreconditioner> make_multigrid(
      const SaddleSystem& system) const {
    std::unique_ptr<VelocityPreconditioner> cycle;
    if (system.has_products())
      cycle = std::make_unique<MultigridByDegree>(communicator_, system);
    else
      cycle = std::make_unique<VelocityMultigrid>(communicator_, system);
    if (system.slow_velocities.num_rows == 0) return cycle;
    WholeVector x(system), result(system);
    return std::make_unique<WithSlowVelocities>(
        std::move(cycle), CoarseSpace(communicator_, system.slow_velocities,
                                      [&](std::span<const double> v, std::span<double> Av) {
                                        std::ranges::copy(v, x.velocities().begin());
                                        multiply(x, result);
                                        std::ranges::copy(result.velocities(), Av.begin());
                                      }));
  }

  /// On the slow pressures the Schur complement is B A⁻¹ Bᵀ + C, A⁻¹ by the preconditioner of the
  /// velocities.
  [[nodiscard]] std::optional<CoarseSpace> make_slow_pressures(const SaddleSystem& system) const {
    if (system.slow_pressures.num_rows == 0) return {};
    WholeVector x(system), result(system);
    return CoarseSpace(
        communicator_, system.slow_pressures, [&](std::span<const double> p, std::span<double> Sp) {
          std::ranges::fill(x.velocities(), 0.0);
          std::ranges::copy(p, x.pressures().begin());
          multiply(x, result);
          multigrid_->apply(system, borrowed_vector(comm(), result.velocities()).get(),
                            borrowed_vector(comm(), x.velocities()).get());
          for (double& value : x.pressures()) value = -value;
          multiply(x, result);
          std::ranges::copy(result.pressures(), Sp.begin());
        });
  }

  /// The operator's product.
  void multiply(const WholeVector& x, WholeVector& result) const {
    petsc_check(MatMult(operator_, borrowed_vector(comm(), x.values).get(),
                        borrowed_vector(comm(), result.values).get()),
                "MatMult");
  }

  /// The Krylov method. It is kept with its vectors, which take a few per cent of a solve to make.
  KSP outer_solver(double rtol) {
    const bool is_new = outer_.get() == nullptr;
    if (is_new) petsc_check(KSPCreate(comm(), outer_.out()), "KSPCreate");
    petsc_check(KSPSetOperators(outer_.get(), iterated(), iterated()), "KSPSetOperators");
    // PETSc refuses a relative tolerance of one or more. The absolute tolerance must have no
    // effect.
    petsc_check(KSPSetTolerances(outer_.get(), std::min(rtol, 0.9), 1e-300, PETSC_DEFAULT,
                                 options_.max_iterations),
                "KSPSetTolerances");
    if (!is_new) return outer_.get();
    PC pc = nullptr;
    petsc_check(KSPGetPC(outer_.get(), &pc), "KSPGetPC");
    petsc_check(PCSetType(pc, PCSHELL), "PCSetType");
    petsc_check(PCShellSetContext(pc, &apply_), "PCShellSetContext");
    petsc_check(PCShellSetApply(pc, apply_shell), "PCShellSetApply");
    petsc_check(KSPSetFromOptions(outer_.get()), "KSPSetFromOptions");
    return outer_.get();
  }

  void iterate(const SaddleSystem& system, std::span<const double> right_hand_side,
               std::span<double> solution, double rtol, LinearReport& report) {
    const double sign = options_.method == SaddleMethod::paper_gmres ? -1.0 : 1.0;
    std::vector<double> consistent_side =
        consistent_right_hand_side(communicator_, system, right_hand_side, sign);
    if (weighted_) weighted_->weigh(consistent_side);
    const Vector b = borrowed_vector(comm(), consistent_side),
                 x = borrowed_vector(comm(), solution);
    const KSP outer = outer_solver(rtol);
    std::vector<PetscReal> history(static_cast<std::size_t>(options_.max_iterations) + 1);
    petsc_check(KSPSetResidualHistory(outer, history.data(), static_cast<PetscInt>(history.size()),
                                      PETSC_TRUE),
                "KSPSetResidualHistory");
    petsc_check(KSPSolve(outer, b.get(), x.get()), "KSPSolve");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0, recorded = 0;
    petsc_check(KSPGetConvergedReason(outer, &reason), "KSPGetConvergedReason");
    petsc_check(KSPGetIterationNumber(outer, &iterations), "KSPGetIterationNumber");
    petsc_check(KSPGetResidualHistory(outer, nullptr, &recorded), "KSPGetResidualHistory");
    report.converged = reason > 0;
    report.reason = KSPConvergedReasons[reason];
    report.iterations = iterations;
    report.residuals.assign(history.begin(), history.begin() + recorded);
    if (report.converged && options_.method != SaddleMethod::minres &&
        may_be_breakdown(rtol, report))
      check_breakdown(b.get(), x.get(), rtol, report);
    if (system.constant_pressure_is_null)
      remove_mean(communicator_, solution.subspan(std::size_t(system.num_velocities())));
  }

  /// Whether the estimate of the residual fell by more than an iteration does before it is small
  /// enough.
  static bool may_be_breakdown(double rtol, const LinearReport& report) {
    const std::vector<double>& residuals = report.residuals;
    return residuals.empty() || residuals.back() < 0.01 * rtol * residuals.front();
  }

  /// Checks the true residual: on a singular operator a Krylov method may stop with a zero residual
  /// estimate and no solution.
  void check_breakdown(Vec b, Vec x, double rtol, LinearReport& report) const {
    Vector residual;
    double norm = 0.0, first = 0.0;
    petsc_check(VecDuplicate(b, residual.out()), "VecDuplicate");
    petsc_check(MatMult(iterated(), x, residual.get()), "MatMult");
    petsc_check(VecAYPX(residual.get(), -1.0, b), "VecAYPX");
    petsc_check(VecNorm(residual.get(), NORM_2, &norm), "VecNorm");
    petsc_check(VecNorm(b, NORM_2, &first), "VecNorm");
    // The square root of the tolerance tells a breakdown from a tolerance slightly missed by
    // roundoff.
    report.converged = norm <= std::sqrt(std::min(rtol, 0.9)) * first;
    if (!report.converged)
      report.reason =
          fmt::format("singular block: breakdown at {:.1e} of the first residual", norm / first);
  }

  /// Drops all references to the caller's arrays and keeps the preconditioner.
  void release() {
    apply_ = nullptr;
    weighted_.reset();
    block_.reset();
    scaling_.reset();
    operator_ = nullptr;
    product_ = {};
    if (communicator_.size() == 1) nested_ = {};
    merged_ = {};
  }

  Communicator communicator_;
  SaddleOptions options_;
  OptionTable table_;
  bool is_checked_ = false;  ///< whether options were checked, after a first solve
  Matrix product_;
  NestedOperator nested_;
  MergedMatrix merged_;
  Mat operator_ = nullptr;                    ///< the product, the nest or the merged matrix
  std::optional<WeightedOperator> weighted_;  ///< with weights of the rows
  Apply apply_;
  KrylovSolver outer_;
  std::int32_t size_ = 0;  ///< of the last system, on this rank
  std::optional<BlockPreconditioner> block_;
  std::optional<DiagonalScaling> scaling_;
  std::unique_ptr<VelocityPreconditioner> multigrid_;
  std::optional<CoarseSpace> slow_pressures_;  ///< made with the multigrid
  std::unique_ptr<PressureLaplacian> pressure_laplacian_;
  std::unique_ptr<Factorization> factorization_;
};

SaddleSolver::SaddleSolver(Communicator communicator, SaddleOptions options)
    : implementation_(std::make_unique<Implementation>(communicator, std::move(options))) {}
SaddleSolver::SaddleSolver(SaddleSolver&&) noexcept = default;
SaddleSolver& SaddleSolver::operator=(SaddleSolver&&) noexcept = default;
SaddleSolver::~SaddleSolver() = default;

LinearReport SaddleSolver::solve(const SaddleSystem& system,
                                 std::span<const double> right_hand_side,
                                 std::span<double> solution, double rtol,
                                 Preconditioner preconditioner) {
  return implementation_->solve(system, right_hand_side, solution, rtol, preconditioner);
}

void SaddleSolver::prepare(const SaddleSystem& system) { implementation_->keep(system); }

}  // namespace meniscus::linear
