// Contact that goes on on a moved geometry: memory of real contact surfaces, rigid bodies that
// start in a pose, number of processes.
#include <gtest/gtest.h>

#include <scree/contact/contact_memory.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <iostream>
#include <random>
#include <sstream>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

/** Two overlapping bodies whose contact surface is the plane through `point`, turned by `angle`. */
std::string
two_blocks(const Point<2> &point, const double angle, const unsigned int degree)
{
  constexpr double gap    = -0.02;
  const auto       number = [](const double x) {
    std::ostringstream text;
    text.precision(17);
    text << x;
    return text.str();
  };
  const double c = std::cos(angle), s = std::sin(angle);
  const auto   corner = [&](const double side) {
    return number(point[0] - s * side) + ", " + number(point[1] + c * side);
  };
  return grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(degree)
         + bodies_text(
           {{"lower", half_space_text(corner(-0.5 * gap), number(-s) + ", " + number(c))},
            {"upper", half_space_text(corner(0.5 * gap), number(s) + ", " + number(-c))}});
}

/** Both bodies turn, and slide on each other by an amount that grows along the surface. */
void
check_moving_planes(const unsigned int degree)
{
  const double       old_angle = 0.1, turn = 0.25;
  const Point<2>     old_point(0., 0.013);
  const Tensor<1, 2> shift({0.02, 0.1});
  const auto         R = [](const double angle) {
    return Tensor<2, 2>({{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}});
  };
  const Tensor<2, 2> Q       = R(turn);
  const Tensor<1, 2> tangent = R(old_angle) * Tensor<1, 2>({1., 0.});
  const Tensor<1, 2> normal  = R(old_angle) * Tensor<1, 2>({0., 1.});
  const auto sliding = [&](const Tensor<1, 2> &x) { return 1e-3 * (1. + 0.3 * (x * tangent)); };

  const CutBodies<2> before(two_blocks(old_point, old_angle, degree));
  ContactPoints<2>   contact = contact_points(before, "stick");
  const Vector       u
    = displacement<2>(before, contact, [&](const unsigned int body, const Point<2> &x) {
        const Tensor<1, 2> rigid = Q * (x - old_point) - (x - old_point) + shift;
        return rigid + (body == 0 ? -0.5 : 0.5) * sliding(x) * (Q * tangent);
      });
  contact.evaluate(u, contact.initial_history());
  const auto memory = remember(contact, MPI_COMM_WORLD);
  ASSERT_GT(memory.size(), 50u);

  const CutBodies<2> after(two_blocks(old_point + shift, old_angle + turn, degree));
  ContactPoints<2>   moved_contact = contact_points(after, "stick");
  const auto         history       = recall(moved_contact, memory);
  // The jump of the rigid motion over the overlap and the sliding, at the place that has moved
  // here.
  const double gap       = -0.02;
  unsigned int n_checked = 0;
  for (unsigned int i = 0; i < moved_contact.points().size(); ++i)
    {
      const Tensor<1, 2> here
        = transpose(Q) * (moved_contact.points()[i].position - old_point - shift);
      const Tensor<1, 2> x = old_point + here;
      // The feet leave the box at its ends, where displacements are other ones.
      if (std::max(std::abs(x[0]), std::abs(x[1])) > 0.9)
        continue;
      ++n_checked;
      const Tensor<1, 2> jump = sliding(x) * (Q * tangent) + gap * (Q * normal - normal);
      const double size = -moved_contact.enforcement().stiffness()[i].tangential * (jump * tangent);
      EXPECT_LE((history.tau[i] - size * (Q * tangent)).norm(), 2e-3 * std::abs(size));
      EXPECT_LE(std::abs(history.tau[i] * moved_contact.points()[i].normal),
                1e-12 * std::abs(size));
    }
  EXPECT_GT(n_checked, moved_contact.points().size() / 2);
}

TEST(MovingContact, TractionsTurnWithTheBodies)
{
  check_moving_planes(1);
  check_moving_planes(2);
}

/** Two discs or balls that overlap, pushed and sheared. */
template <int dim>
std::string
two_balls(const unsigned int degree)
{
  const std::string zeros = dim == 2 ? "0" : "0, 0";
  return (dim == 2 ? grid_text("-1, -1", "1, 1", "4, 4", 3)
                   : grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 2))
         + degree_text(degree)
         + bodies_text({{"left", ball_text("-0.4, " + zeros, 0.46)},
                        {"right", ball_text("0.41, " + zeros, 0.45)}});
}

template <int dim>
ContactPoints<dim>
evaluated(const CutBodies<dim> &model)
{
  ContactPoints<dim> contact = contact_points(model, "stick");
  contact.evaluate(displacement<dim>(model, contact,
                                     [](const unsigned int body, const Point<dim> &x) {
                                       Tensor<1, dim> u;
                                       u[0] = body == 0 ? 0.01 : -0.01 * x[0];
                                       u[1] = body == 0 ? 0.002 * x[0] : 0.003 * (x[1] + 1.);
                                       return u;
                                     }),
                   contact.initial_history());
  return contact;
}

template <int dim>
void
check_null_step(const unsigned int degree)
{
  // No mean displacement: the contact points are the same ones, and get what they had.
  const CutBodies<dim> model(two_balls<dim>(degree));
  ContactPoints<dim>   contact = contact_points(model, "stick");
  contact.evaluate(displacement<dim>(model, contact,
                                     [](const unsigned int body, const Point<dim> &) {
                                       Tensor<1, dim> u;
                                       u[1] = body == 0 ? 0.002 : -0.002;
                                       return u;
                                     }),
                   contact.initial_history());
  const auto memory  = remember(contact, MPI_COMM_WORLD);
  const auto again   = contact_points(model, "stick");
  const auto history = recall(again, memory);
  double     scale   = 0.;
  for (const auto &response : contact.responses())
    scale = std::max(scale, response.tau.norm());
  EXPECT_GT(scale, 1.);
  for (unsigned int i = 0; i < again.points().size(); ++i)
    if (contact.gap(i) <= contact.points()[i].cell_size)
      {
        EXPECT_LE((history.tau[i] - contact.responses()[i].tau).norm(), 1e-12 * scale);
        EXPECT_NEAR(history.pressure[i], contact.responses()[i].pressure, 1e-12 * scale);
      }
  for (const auto &force : transferred_forces(again, memory, history, MPI_COMM_WORLD))
    {
      EXPECT_GT(force.tangential_before.norm(), 1e-3 * scale);
      EXPECT_LE((force.tangential_after - force.tangential_before).norm(),
                1e-10 * force.tangential_before.norm());
      EXPECT_LE((force.total_after - force.total_before).norm(), 1e-10 * force.total_before.norm());
    }
}

TEST(MovingContactMPI, NullStepChangesNothing)
{
  check_null_step<2>(1);
  check_null_step<2>(2);
  check_null_step<3>(1);
}

template <int dim>
void
check_resultants(const unsigned int degree, const unsigned int other_degree)
{
  const CutBodies<dim> model(two_balls<dim>(degree)), other(two_balls<dim>(other_degree));
  const auto           memory  = remember(evaluated(model), MPI_COMM_WORLD);
  const auto           contact = contact_points(other, "stick");
  auto                 history = recall(contact, memory);
  const auto           missing = [&](const ContactMemory<dim> &of) {
    const auto force = transferred_forces(contact, of, history, MPI_COMM_WORLD)[0];
    return (force.tangential_after - force.tangential_before).norm()
           / force.tangential_before.norm();
  };
  const double before = missing(memory);
  const auto   plain  = history;
  keep_resultants(contact, memory, history, MPI_COMM_WORLD);
  std::cout << "missing of the force: " << before << ", then " << missing(memory) << '\n';
  EXPECT_GT(before, 1e-6);
  EXPECT_LT(missing(memory), 0.05 * before);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      EXPECT_LE(std::abs(history.tau[i] * contact.points()[i].normal),
                1e-12 * history.tau[i].norm());
      EXPECT_LE((history.tau[i] - plain.tau[i]).norm(), 2. * before * plain.tau[i].norm());
    }

  // A surface that has lost a half of its force is another one.
  auto doubled = memory;
  for (auto &tau : doubled.tau)
    tau *= 2.;
  history = plain;
  keep_resultants(contact, doubled, history, MPI_COMM_WORLD);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    EXPECT_EQ(history.tau[i], plain.tau[i]);
}

TEST(MovingContactMPI, ExchangeOfPointsKeepsResultants)
{
  check_resultants<2>(1, 2);
  check_resultants<3>(1, 2);
}

template <int dim>
void
compare(const ContactMemory<dim> &one, const ContactMemory<dim> &other, const double tolerance)
{
  ASSERT_EQ(one.size(), other.size());
  EXPECT_EQ(one.body_a, other.body_a);
  EXPECT_EQ(one.body_b, other.body_b);
  EXPECT_EQ(one.cell_size, other.cell_size);
  for (std::size_t i = 0; i < one.size(); ++i)
    {
      EXPECT_LE(one.position[i].distance(other.position[i]), tolerance);
      EXPECT_LE((one.normal[i] - other.normal[i]).norm(), tolerance);
      EXPECT_NEAR(one.weight[i], other.weight[i], tolerance);
      EXPECT_LE((one.tau[i] - other.tau[i]).norm(), 1e4 * tolerance);
      EXPECT_NEAR(one.pressure[i], other.pressure[i], 1e4 * tolerance);
    }
}

template <int dim>
void
compare_processes(const unsigned int degree)
{
  const auto           input = BodiesInput<dim>::from_string(two_balls<dim>(degree));
  const CutBodies<dim> alone(input, MPI_COMM_SELF), together(input, MPI_COMM_WORLD);
  const auto           contact_alone = evaluated(alone), contact = evaluated(together);
  const auto           memory_alone = remember(contact_alone, MPI_COMM_SELF),
             memory                 = remember(contact, MPI_COMM_WORLD);
  ASSERT_GT(memory.size(), 10u);
  compare(memory, memory_alone, 1e-13);
  const auto forces_alone = transferred_forces(contact_alone, memory_alone,
                                               recall(contact_alone, memory_alone), MPI_COMM_SELF);
  const auto forces  = transferred_forces(contact, memory, recall(contact, memory), MPI_COMM_WORLD);
  const double scale = forces[0].total_before.norm();
  EXPECT_GT(scale, 0.);
  EXPECT_LE((forces[0].total_after - forces_alone[0].total_after).norm(), 1e-11 * scale);
  EXPECT_LE((forces[0].tangential_after - forces_alone[0].tangential_after).norm(), 1e-11 * scale);
}

TEST(MovingContactMPI, DoesNotDependOnTheNumberOfProcesses)
{
  compare_processes<2>(1);
  compare_processes<2>(2);
  compare_processes<3>(1);
}

TEST(MovingContact, MemoryIsWrittenAndRead)
{
  const CutBodies<2> model(two_balls<2>(1));
  const auto         memory = remember(evaluated(model), MPI_COMM_WORLD);
  ASSERT_GT(memory.size(), 10u);
  std::stringstream stream;
  boost::archive::binary_oarchive(stream) << memory;
  ContactMemory<2> copy;
  boost::archive::binary_iarchive(stream) >> copy;
  compare(memory, copy, 0.);
}

/** A block and a rigid ball, whose centre is `centre` and which turns about `reference`. */
template <int dim>
std::string
block_and_ball(const Point<dim> &centre, const Point<dim> &reference)
{
  const auto text = [](const Point<dim> &x) {
    std::ostringstream stream;
    stream.precision(17);
    for (unsigned int d = 0; d < dim; ++d)
      stream << (d > 0 ? ", " : "") << x[d];
    return stream.str();
  };
  const std::string motion
    = dim == 2 ? "set Force x = 0\nset Force y = 0\nset Moment = 0"
               : "set Force x = 0\nset Force y = 0\nset Force z = 0\nset Moment x = 0\nset "
                 "Moment y = 0\nset Moment z = 0";
  return (dim == 2 ? grid_text("-1, -1", "1, 1", "4, 4", 3)
                   : grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 2))
         + degree_text(1)
         + bodies_text(
           {{"block", half_space_text(dim == 2 ? "0, 0.013" : "0, 0, 0.013",
                                      dim == 2 ? "0.05, 1" : "0.05, 0.1, 1")},
            {"ball", shape_text("ball", "set Centre = " + text(centre) + "\nset Radius = 0.5")
                       + motion_text(motion + "\nset Reference point = " + text(reference))}});
}

template <int dim>
Vector
rigid_motion(const CutBodies<dim> &model, const typename RigidPose<dim>::Unknowns &q)
{
  Vector u(model.space->owned(), MPI_COMM_WORLD);
  for (unsigned int m = 0; m < q.size(); ++m)
    u(model.space->rigid_unknown(1) + m) = q[m];
  u.compress(VectorOperation::insert);
  return u;
}

/** The ball of the other model, moved by its pose q to where this model has its ball. */
template <int dim>
struct PosedBall
{
  PosedBall()
  {
    Point<dim> centre, reference;
    centre[0]       = 0.1;
    centre[dim - 1] = 0.3;
    reference[0]    = 0.3;
    reference[1]    = -0.2;
    const CutBodies<dim> initial(block_and_ball(centre, reference));
    rigid = initial.bodies[1].rigid;
    for (unsigned int m = 0; m < q.size(); ++m)
      q[m] = m < dim ? 0.05 - 0.03 * m : rigid->radius * (0.4 - 0.15 * (m - dim));
    const RigidPose<dim> pose(*rigid, q);
    centre += pose.displacement(centre);
    // High enough for an overlap that is no deeper than a few cells.
    lift = 0.46 - centre[dim - 1];
    q[dim - 1] += lift;
    centre[dim - 1] += lift;
    const RigidPose<dim> lifted(*rigid, q);
    current_reference = reference + lifted.displacement(reference);
    model             = std::make_unique<CutBodies<dim>>(block_and_ball(centre, current_reference));
  }

  double                                lift;
  std::shared_ptr<const RigidBody<dim>> rigid;
  typename RigidPose<dim>::Unknowns     q;
  Point<dim>                            current_reference;
  std::unique_ptr<CutBodies<dim>>       model;
};

TEST(MovingContact, RigidBodyStartsInAPose)
{
  // Turning further about the reference point: the pose adds up in 2D. What is the increment of a
  // ball that starts at its pose is the motion of one that starts here.
  PosedBall<2>           ball;
  CutBodies<2>          &model = *ball.model;
  RigidPose<2>::Unknowns increment{{0.01, -0.02, 0.03}}, q = ball.q;
  ContactPoints<2>       here = contact_points(model, "stick");
  const auto             own  = rigid_motion(model, increment);
  here.evaluate(own, here.initial_history());
  EXPECT_NEAR(model.bodies[1].rigid->radius, ball.rigid->radius, 1e-12);
  model.bodies[1].rigid  = ball.rigid;
  model.bodies[1].pose   = RigidPose<2>(*ball.rigid, ball.q);
  ContactPoints<2> posed = contact_points(model, "stick");
  ASSERT_EQ(posed.points().size(), here.points().size());
  ASSERT_GT(posed.points().size(), 8u);
  posed.evaluate(rigid_motion(model, q), posed.initial_history());
  for (const auto &jump : posed.jumps())
    EXPECT_LE(jump.norm(), 1e-15);
  for (unsigned int m = 0; m < q.size(); ++m)
    q[m] += increment[m];
  posed.evaluate(rigid_motion(model, q), posed.initial_history());
  for (unsigned int i = 0; i < posed.points().size(); ++i)
    {
      EXPECT_GT(here.jumps()[i].norm(), 1e-3);
      EXPECT_LE((posed.jumps()[i] - here.jumps()[i]).norm(), 1e-13);
      EXPECT_LE((posed.mean_displacements()[i] - 0.5 * here.jumps()[i]).norm(), 1e-13);
    }
}

/** |dr + K v|/|K v| by central differences, for a rigid body that starts in a pose. */
template <int dim>
void
compare_tangent()
{
  PosedBall<dim>  ball;
  CutBodies<dim> &model          = *ball.model;
  model.bodies[1].rigid          = ball.rigid;
  model.bodies[1].pose           = RigidPose<dim>(*ball.rigid, ball.q);
  ContactPoints<dim>     contact = contact_points(model, "stick");
  const auto             history = contact.initial_history();
  DynamicSparsityPattern pattern(model.space->n_dofs());
  for (const auto &unknowns :
       contact.jump_operator().couplings(std::vector<bool>(contact.points().size(), true)))
    for (const auto row : unknowns)
      pattern.add_entries(row, unknowns.begin(), unknowns.end());
  TrilinosWrappers::SparseMatrix K;
  K.reinit(pattern);

  std::mt19937                           engine(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  Vector                                 u = rigid_motion(model, ball.q), v(u), Kv(u);
  for (DofIndex i = 0; i < model.space->n_dofs(); ++i)
    {
      u(i) = u(i) + 1e-3 * number(engine);
      v(i) = number(engine);
    }
  u.compress(VectorOperation::insert);
  v.compress(VectorOperation::insert);
  contact.evaluate(u, history);
  unsigned int n_closed = 0;
  for (const auto &response : contact.responses())
    n_closed += response.status != ContactStatus::open;
  ASSERT_GT(n_closed, 4u);
  contact.add_to_matrix(K);
  K.compress(VectorOperation::add);
  K.vmult(Kv, v);
  Vector difference(u);
  difference = 0.;
  for (const double sign : {1., -1.})
    {
      Vector moved_u(u), residual(u);
      residual = 0.;
      moved_u.add(sign * 1e-6, v);
      contact.evaluate(moved_u, history);
      contact.add_to_residual(residual);
      residual.compress(VectorOperation::add);
      difference.add(sign / 2e-6, residual);
    }
  difference += Kv;
  std::cout << "  " << dim << "D: |dr + K v|/|K v| = " << difference.l2_norm() / Kv.l2_norm()
            << "\n";
  EXPECT_LE(difference.l2_norm(), 1e-7 * Kv.l2_norm());
}

TEST(MovingContact, TangentOfARigidBodyInAPose)
{
  compare_tangent<2>();
  compare_tangent<3>();
}
} // namespace
} // namespace scree
