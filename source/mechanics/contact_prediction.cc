#include <scree/contact/interior_contact.h>
#include <scree/mechanics/contact_prediction.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
// The constants that contact_prediction.h documents, and those of the targets of p s.
constexpr double       small_complementarity = 1e-4;
constexpr double       small_gap             = 1e-3; // cells
constexpr double       small_residual        = 1e-2;
constexpr double       no_force              = 1e-5;
constexpr unsigned int max_iterations        = 40;
constexpr double       linear_tolerance      = 1e-4;
constexpr double       first_target          = 0.2;
constexpr double       least_target          = 0.05;
constexpr double       largest_target        = 0.5;

template <int dim>
using Vector = typename Equilibrium<dim>::Vector;

/** Half the size of the smaller body of each pair. */
template <int dim>
std::vector<double>
lengths_of_pairs(const DiscreteProblem<dim> &problem)
{
  std::vector<double> of_bodies, result;
  for (const Body<dim> &body : problem.bodies)
    of_bodies.push_back(RigidMotions<dim>(body).length());
  for (const ContactPair &pair : problem.contact().pairs())
    result.push_back(std::min(of_bodies[pair.a], of_bodies[pair.b]));
  return result;
}

/** Newton's method of the interior point, bodies having their tangent at u_0. */
template <int dim>
class LinearisedBodies
{
public:
  LinearisedBodies(const DiscreteProblem<dim> &problem, const ContactHistory<dim> &history,
                   const Vector<dim> &u_0)
      : problem(problem)
      , equilibrium(problem.equilibrium())
      , contact(problem.contact())
      , change(u_0)
      , of_bodies(u_0)
      , of_contact(u_0)
  {
    equilibrium.residual(u_0, history, of_bodies);
    at_start = equilibrium.forces_without_inertia();
    change   = 0.;
  }

  /** One step to p s = mu; the linear iterations. */
  unsigned int step(const double mu, const Vector<dim> &u_0, InteriorContact<dim> &interior);

  /** Whether forces balance but for what Newton's method finds at once, before the last step. */
  bool is_balanced() const
  {
    return residual <= std::max(small_residual * contact_size, no_force * first_contact_size);
  }

  const DiscreteProblem<dim> &problem;
  Equilibrium<dim>           &equilibrium;
  ContactPoints<dim>         &contact;
  Vector<dim>                 change; //!< u' - u_0
  double                      alpha = 0.;

private:
  /** B^T f. */
  const Vector<dim> &from_points(std::vector<dealii::Tensor<1, dim>> &&f);

  typename Equilibrium<dim>::Matrix stiffness; //!< K_0
  Vector<dim>                       at_start;  //!< r(u_0) without contact
  Vector<dim>                       of_bodies, of_contact;
  double                            residual = 0., contact_size = 0., first_contact_size = 0.;
};

template <int dim>
const Vector<dim> &
LinearisedBodies<dim>::from_points(std::vector<dealii::Tensor<1, dim>> &&f)
{
  const JumpOperator<dim> &B = contact.jump_operator();
  of_contact                 = 0.;
  B.add_forces(B.forces(std::move(f)), of_contact);
  of_contact.compress(dealii::VectorOperation::add);
  equilibrium.set_zero_where_not_sought(of_contact);
  return of_contact;
}

template <int dim>
unsigned int
LinearisedBodies<dim>::step(const double mu, const Vector<dim> &u_0, InteriorContact<dim> &interior)
{
  equilibrium.tangent_without_contact(interior.taken(), stiffness);
  auto tangent = interior.tangent(mu);
  stiffness.vmult(of_bodies, change);
  equilibrium.set_zero_where_not_sought(of_bodies);
  Vector<dim> r(at_start);
  r -= of_bodies;
  r += from_points(std::move(tangent.forces));
  residual           = r.l2_norm();
  contact_size       = of_contact.l2_norm();
  first_contact_size = std::max(first_contact_size, contact_size);
  r += from_points(std::move(tangent.changes));
  Vector<dim> du(r), u(u_0);
  const auto  result
    = problem.solver().solve(equilibrium.tangent_with_contact(stiffness, tangent.stiffness), r,
                             equilibrium.is_symmetric_without_contact(), linear_tolerance, du);
  const auto go = [&](const double part) {
    u = u_0;
    u += change;
    u.add(part, du);
    contact.take_jumps(equilibrium.with_ghosts(u));
  };
  go(1.);
  alpha = interior.step_length();
  if (alpha < 1.)
    go(alpha);
  interior.advance(alpha);
  interior.take_near();
  change.add(alpha, du);
  return result.iterations;
}
} // namespace

template <int dim>
ContactPrediction<dim>
contact_prediction(const DiscreteProblem<dim> &problem, const ContactHistory<dim> &history,
                   const typename Equilibrium<dim>::Vector &u,
                   const std::function<bool()>             &is_interrupted)
{
  ContactPrediction<dim> result{u};
  LinearisedBodies<dim>  linearised(problem, history, u);
  InteriorContact<dim>   interior(linearised.contact, history, lengths_of_pairs(problem),
                                  problem.communicator());
  const double           first  = interior.complementarity();
  const double           h      = problem.grid.finest_size();
  double                 target = first_target;
  try
    {
      for (unsigned int n = 0; n < max_iterations && first > 0. && !is_interrupted(); ++n)
        {
          const double complementarity = interior.complementarity();
          const bool   is_closed       = complementarity <= small_complementarity * first
                                 && interior.infeasibility() <= small_gap * h;
          result.n_linear_iterations += linearised.step(target * complementarity, u, interior);
          ++result.n_iterations;
          if (is_closed && linearised.is_balanced())
            break;
          target = std::clamp(std::pow(1. - linearised.alpha, 2), least_target, largest_target);
        }
    }
  catch (const LinearSolverFailure &)
    {
      // What was found before is a guess, too.
    }
  linearised.equilibrium.advance(linearised.change, result.u);
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                   \
  template ContactPrediction<dim> contact_prediction(                                            \
    const DiscreteProblem<dim> &, const ContactHistory<dim> &, const Equilibrium<dim>::Vector &, \
    const std::function<bool()> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
