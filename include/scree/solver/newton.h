#pragma once

#include <scree/parameters/section.h>
#include <scree/solver/newton_result.h>
#include <scree/solver/partition.h>

#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
/** How the length of a Newton step is chosen. */
enum class LineSearch
{
  none,
  residual,
  work
};

/** What a parameter file says about Newton's method. */
struct NewtonParameters
{
  /** Converged at |r| <= relative_tolerance * reference + absolute_tolerance; > 0. */
  double relative_tolerance = 1e-9;

  /** In the unit of the residual (force); >= 0. */
  double absolute_tolerance = 0;

  /** Of both methods together. */
  unsigned int max_iterations = 100;

  /** Ends after so many, too, unless |r| falls to a tenth or, in two, to a hundredth; no entry. */
  unsigned int patience = 0xffffffff;

  LineSearch line_search = LineSearch::work;

  /** The loosest relative tolerance of a linear system, 0 <= . < 1; 0: as tight as can be. */
  double loosest_linear_tolerance = 1e-3;

  /** Reads the entries of the section and records what is not allowed. */
  void declare(const ParameterSection &section);
};

/** One Newton iteration, for logs. */
struct NewtonIteration
{
  /** 0 for the residual at the start, then the number of solved systems. */
  unsigned int number = 0;

  /** |r|_2 after the update, in the unit of the residual. */
  double residual = 0;

  /** The norm of forces that the tolerance is relative to. */
  double reference = 0;

  /** The |r|_2 that would be accepted now. */
  double tolerance = 0;

  double increment   = 0; //!< |alpha du|_2 of the update, in the unit of the unknowns
  double step_length = 1; //!< alpha of the update

  /** Residual evaluations that the line search added to the one of the full step. */
  unsigned int extra_evaluations = 0;
};

/**
 * Newton's method for r(u) = 0 with r = f_ext - f_int and the tangent K = -dr/du:
 *
 *     K(u) du = r(u),    u <- u + alpha du.
 *
 * It knows vectors only. All of them are distributed alike, without ghost entries.
 *
 * *Convergence:* |r|_2 <= relative tolerance * reference + absolute tolerance, where a hook
 * supplies the reference, a norm of forces at the present u. What did not fall to half in either of
 * the last two iterations is accepted (converged_at_round_off) if it is at most 100 times the
 * tolerance and the last |du|_2 was at most 1e-10 |u|_2, or if a hook says that only the accuracy
 * of the geometry is left. What did not fall below half of the least in 8 iterations, in 3 below
 * 100 times the tolerance, and is within twice of that, is accepted (converged_at_standstill) if a
 * hook says that all is in balance. So is the u of the least |r| below 100 times the tolerance, 3
 * iterations later.
 *
 * *Line searches:* `residual` halves alpha, 8 times at most, until
 * |r(u + alpha du)| <= (1 - 1e-4 alpha) |r(u)| (Armijo with the merit function |r|), and further
 * while that lowers |r| and |r| > 0.3 |r(u)|; it takes the best alpha it tried. `work` looks at
 * G(alpha) = r(u + alpha du) . du: where G(1) has the opposite sign of G(0) and |G(1)| > 0.8
 * |G(0)|, the step went too far, and a zero of G is enclosed by the Illinois variant of regula
 * falsi until |G| <= 0.8 |G(0)|, with 6 more evaluations at most (Matthies, Strang, Int. J. Numer.
 * Meth. Engng 14, 1979, 1613-1626). Parts of the unknowns between which no forces act, at u and at
 * the end of the full step, have a G and an alpha each. In all cases a step to a residual that is
 * not finite is halved.
 *
 * *Lagged friction:* the tangent of what slides does not resist it and sends single bodies far
 * beyond where they find hold, and a search shortens the step of all. After a step of alpha < 1/2
 * or to a larger |r| the bounds of friction stay in the next one at what they are at u (a step to
 * 4 |r| is taken again so, with a larger s). What is linear otherwise then has a convex energy, of
 * which the step is a proximal one (Kelley, Keyes, SIAM J. Numer. Anal. 35, 1998, 508-523), with an
 * artificial mass M that holds what moves freely:
 *
 *     (K(u) + s M) du = r(u),    G(alpha) = r(u + alpha du) . du - alpha s du . M du,
 *
 * where alpha = 1 if |G(1)| <= G(0)/2 or G(1) > 0, else |G(alpha)| <= G(0)/10: near the minimum
 * along du of the energy plus s |u' - u|_M^2/2. s is 1e-4 at first, a tenth, at least 1e-9, after a
 * step of alpha > 1/2 and four times as large, at most 0.1, after one of alpha < 0.2. A lagged step
 * of alpha = 1 ends it if |r| falls to half or n such steps followed each other, n = 1 at first and
 * twice as many after each time; so do 5 steps that did not halve the least |r|, and 5 steps
 * without lagging follow. M never enters r: what converged is in balance without it. (The lagging
 * is that of incremental potentials: Li et al., ACM Trans. Graph. 39, 2020, 49.)
 *
 * *Linear tolerances:* `eta = 0.9 (|r| / |r_before|)^2`, in the first iteration the loosest one
 * (Eisenstat, Walker, SIAM J. Sci. Comput. 17, 1996, choice 2 with its safeguard), never above the
 * loosest and never below what ends the iteration, 0.1 tolerance / |r|.
 *
 * *Balance:* before the first and after every iteration a hook may move u to where forces on what
 * moves freely balance, 6 times at most: no tangent knows of contact that is lost. Where friction
 * can be lagged, u stays if that raises |r|, but for three times in which |r| stays below what it
 * was before the iteration; the next balance is then tried at a tenth of |r|.
 *
 * *Failure:* too many iterations, a residual that is not finite or 1e8 times the larger of the
 * reference and the residual at the start, or a LinearSolverFailure. Then u is the last iterate and
 * the caller goes back to its saved state.
 */
class Newton
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** What the solver asks of its user. */
  struct Hooks
  {
    /** Computes r(u); zero on constrained rows. `r` comes with the distribution of u. */
    std::function<void(const Vector &u, Vector &r)> residual;

    /**
     * Solves K(u) du = r to |r - K du| <= tolerance |r|, or better; zero on constrained rows.
     * Called for the u and r of the last call of `residual`. May throw LinearSolverFailure (on all
     * processes).
     */
    std::function<void(const Vector &u, const Vector &r, double tolerance, Vector &du)> solve;

    /** u += du, or along a curve that begins with du; may be empty. */
    std::function<void(const Vector &du, Vector &u)> advance;

    /** Moves the u of the last `residual` to where forces on what moves freely balance; false: it
     * stays. May be empty. */
    std::function<bool(Vector &u)> balance;

    /** Whether `r`, that of the last `residual`, is below the tolerance but for what the accuracy
     * of the geometry leaves. May be empty. */
    std::function<bool(const Vector &r, double tolerance)> is_geometric;

    /** Whether all is in balance at the u of the last `residual`. May be empty. */
    std::function<bool(const Vector &u, double residual)> is_in_balance;

    /** A norm of forces, in the unit of r, at the u of the last call of `residual`. */
    std::function<double()> reference;

    /** Whether to end unsolved after this iteration (collective); may be empty. */
    std::function<bool()> is_interrupted;

    /** Told of each iteration; may be empty. */
    std::function<void(const NewtonIteration &)> observe;

    /**
     * Freezes the bounds of friction at those of the last residual() and puts s M with this s in K;
     * empty: both are again as they were. May be empty: friction is never lagged.
     */
    std::function<void(std::optional<double> s)> lag;

    /** s M du with the s of the last lagged step; needed with `lag`. */
    std::function<Vector(const Vector &du)> mass;

    /**
     * Parts of the unknowns on which no forces from others act at the u of the last residual()
     * and of all back to where it was called with `begins` (collective). May be empty.
     */
    std::function<Partition(const bool begins)> parts;
  };

  /** Keeps copies of both. */
  Newton(const NewtonParameters &parameters, const Hooks &hooks);

  /** Solves for u, which enters with the first guess and satisfies the constraints (prescribed
   * values included). */
  NewtonResult solve(Vector &u) const;

private:
  /** A trial of the line search: the alpha, and the u and r there. */
  struct Step
  {
    double       alpha       = 1; //!< of parts, the mean by their |r|^2
    unsigned int evaluations = 0;
    double       norm        = 0;
    Vector       u;
    Vector       r;
  };
  struct Search;
  struct Progress;
  struct End;
  struct Best;

  /** How the iteration ends here, if it does. */
  std::optional<End> end_of(const std::vector<double> &residuals, NewtonIteration &iteration,
                            Vector &u, Vector &r, Best &best) const;

  /** Whether the best u is to be taken, then it is; notes it. */
  bool is_best_in_balance(const bool is_last, NewtonIteration &iteration, Vector &u, Vector &r,
                          Best &best) const;

  bool can_lag() const;

  /** A step from u, where |r(u)| = norm; r: the same or with another tangent behind it. */
  Step take_step(const double linear_tolerance, const double norm, const Vector &u, Vector &r,
                 Vector &du, Progress &progress) const;

  /** A step with lagged friction and the factor s of the mass. */
  Step lagged_step(const double mass, const double linear_tolerance, const Vector &u, Vector &r,
                   Vector &du) const;

  Step search_energy(const Vector &u, const Vector &du, const Vector &r) const;

  Step search(const Vector &u, const Vector &du, const Vector &r, const double norm) const;

  /** The step of alpha = 1, or the longest one tried where r is finite. */
  Step whole_step(const Vector &u, const Vector &du, const double shortening) const;

  Step search_residual(Step step, const Vector &u, const Vector &du, const double norm) const;

  /** Looks for zeros of the G of all parts at once. @param mass_du s M du, null: s = 0 */
  Step search_zeros(const Search &search, const Vector &u, const Vector &du, const Vector &r,
                    const Vector *mass_du) const;

  /** Begins to note which parts act on each other. */
  void begin_parts() const;

  /** Hooks::balance until it leaves u; whether it moved it. r is r(u) before and after. */
  bool balance(Vector &u, Vector &r) const;

  /** Hooks::balance after a step, unless it raises |r|, see the class documentation. */
  void balance_after(Step &step, const double norm_before, Progress &progress) const;

  void evaluate(Step &step, const double alpha, const Vector &u, const Vector &du) const;

  NewtonParameters parameters;
  Hooks            hooks;
};
} // namespace scree
