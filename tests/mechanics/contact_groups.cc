// Which bodies touch, and the parts of the unknowns that belong to them.
#include <gtest/gtest.h>

#include <scree/mechanics/contact_groups.h>

#include <deal.II/base/mpi.h>

#include "../contact/contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

/** Three discs side by side on a rigid floor that all of them touch. */
std::string
three_discs()
{
  return grid_text("-1, -0.5", "1, 0.5", "4, 2", 3) + degree_text(1)
         + bodies_text({{"floor", half_space_text("0, -0.2", "0, 1")
                                    + motion_text("    set Displacement y = t")},
                        {"left", ball_text("-0.42, 0", 0.2)},
                        {"middle", ball_text("0, 0", 0.2)},
                        {"right", ball_text("0.42, 0", 0.2)}});
}

void
check_groups()
{
  const CutBodies<2> model(three_discs());
  auto               contact = contact_points(model);
  ContactGroups<2>   groups(*model.space, model.bodies, contact);
  const auto         press = [&](const double left, const double right) {
    contact.evaluate(
              displacement<2>(model, contact,
                      [=](const unsigned int body, const Point<2> &) {
                        return Tensor<1, 2>({body == 1 ? left : body == 3 ? right : 0., -0.01});
                      }),
              contact.initial_history());
    groups.add();
  };
  // All press the floor, which joins nothing.
  press(0., 0.);
  EXPECT_EQ(groups.groups(), (std::vector<unsigned int>{0, 1, 2, 3}));
  press(0.03, 0.);
  EXPECT_EQ(groups.groups(), (std::vector<unsigned int>{0, 1, 1, 2}));
  // What touched before still counts.
  press(0., -0.03);
  EXPECT_EQ(groups.groups(), (std::vector<unsigned int>{0, 1, 1, 1}));
  groups.clear();
  press(0., -0.03);
  EXPECT_EQ(groups.groups(), (std::vector<unsigned int>{0, 1, 2, 2}));

  const Partition partition = groups.partition();
  EXPECT_EQ(partition.n_parts, 3u);
  const Vector u = displacement<2>(model, contact, [](const unsigned int body, const Point<2> &) {
    return Tensor<1, 2>({1. * body, 0.});
  });
  Vector       here(model.space->owned(), model.grid.communicator()), one(here);
  here            = u;
  one             = 1.;
  const auto sums = partition.products(here, here), means = partition.products(here, one);
  EXPECT_DOUBLE_EQ(sums[1], means[1]); // only the left disc, where u = 1
  EXPECT_NEAR(sums[1] + sums[2], here.norm_sqr(), 1e-9);
  partition.scale({1., 0., 2.}, here);
  EXPECT_NEAR(here.norm_sqr(), 4. * sums[2], 1e-9);
}

TEST(ContactGroups, BodiesThatTouch)
{
  check_groups();
}

TEST(ContactGroupsMPI, BodiesThatTouch)
{
  check_groups();
}
} // namespace
} // namespace scree
