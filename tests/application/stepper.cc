// A step that is rejected leaves the state as it was; a model that is restored from a gathered
// state takes the next step to the last bit as the one that went on.
#include <gtest/gtest.h>

#include <scree/application/implicit_stepper.h>
#include <scree/application/simulation.h>

#include <string>

#include "../output/files.h"

using namespace scree;
using namespace dealii;

namespace
{
const std::string contact_and_time = R"(
subsection Contact
  set Names = all
  subsection all
    set Law = coulomb
    set Friction coefficient = 0.3
  end
end
subsection Time
  set Steps = 4
end
)";

/** A block that is pressed on a bed and drawn along it. */
std::string
block_on_bed(const std::string &moving_geometry)
{
  return R"(
subsection Grid
  set Lower corner = -1, -1
  set Upper corner = 1, 1
  set Cells = 4, 4
  set Finest level = 1
end
subsection Materials
  set Names = m
  subsection m
    set Young's modulus = 100
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  set Names = bed, block
  subsection bed
    set Material = m
    subsection Shape
      set Type = half space
      set Point = 0, 0.03
      set Normal = 0, 1
    end
    subsection Boundary conditions
      set Names = base
      subsection base
        set On = y-
        set Value = 0; 0
      end
    end
  end
  subsection block
    set Material = m
    subsection Shape
      set Type = box
      set Lower corner = -0.47, 0.03
      set Upper corner = 0.46, 0.79
    end
    subsection Boundary conditions
      set Names = top
      subsection top
        set On = surface
        set Where = y > 0.7
        set Value = 0.1*t; -0.05*t
      end
    end
  end
end
)" + contact_and_time
         + R"(
subsection Moving geometry
)" + moving_geometry
         + "end\n";
}

const std::string rubber_and_steel = R"(
subsection Materials
  set Names = rubber, steel
  subsection rubber
    set Young's modulus = 100
    set Poisson's ratio = 0.3
  end
  subsection steel
    set Law = rigid
  end
end
)";

/** A rigid wall that moves. */
std::string
wall(const std::string &name, const std::string &point, const std::string &normal,
     const std::string &motion)
{
  return "subsection " + name + "\nset Material = steel\nsubsection Shape\nset Type = half space\n"
         + "set Point = " + point + "\nset Normal = " + normal + "\nend\nsubsection Motion\nset "
         + "Displacement " + motion + "\nend\nend\n";
}

/** A loose disc that a rigid wall pushes by `cells` finest cells in a step. */
std::string
pushed_disc(const double cells)
{
  return R"(
subsection Grid
  set Lower corner = 0, 0
  set Upper corner = 4, 2
  set Cells = 4, 2
  set Finest level = 3
end
)" + rubber_and_steel
         + R"(subsection Bodies
  set Names = disc, wall
  subsection disc
    set Material = rubber
    subsection Shape
      set Type = ball
      set Centre = 1.01, 1
      set Radius = 0.5
    end
  end
)" + wall("wall", "0.5, 0", "1, 0", "x = " + std::to_string(cells / 8.) + "*t")
         + R"(end
subsection Moving geometry
  set Update = every step
end
)";
}

/** Six loose discs between rigid walls that close in. @param more lines of section Moving geometry
 */
std::string
packing(const std::string &more = "")
{
  return R"(
subsection Grid
  set Lower corner = -2, -2
  set Upper corner = 14, 14
  set Cells = 4, 4
  set Finest level = 2
end
)" + rubber_and_steel
         + R"(subsection Bodies
  set Names = disc, left, right, bottom, top
  subsection disc
    set Material = rubber
    set Family = packing
    subsection Packing
      set Number = 6
      set Lower corner = 0, 0
      set Upper corner = 12, 12
      set Size ratio = 1.5
      set Seed = 2
    end
  end
)" + wall("left", "0, 0", "1, 0", "x = 0.1*t")
         + wall("right", "12, 0", "-1, 0", "x = -0.1*t")
         + wall("bottom", "0, 0", "0, 1", "y = 0.1*t") + wall("top", "0, 12", "0, -1", "y = -0.1*t")
         + "end\n" + contact_and_time + "subsection Moving geometry\nset Update = every step\n"
         + more + "end\n";
}

/** Model and stepper of an input, without results. */
struct ModelRun
{
  explicit ModelRun(const std::string &text)
      : parameters(read(text))
      , run_log{Log(MPI_COMM_WORLD, ""), {}, {}}
      , control(parameters.time)
      , model(parameters, control.step_size(), MPI_COMM_WORLD, run_log)
      , stepper(parameters, control, model, run_log)
  {
  }

  static Parameters<2> read(const std::string &text)
  {
    ParameterFile file = ParameterFile::from_string(text);
    Parameters<2> result;
    result.declare(file);
    file.check();
    return result;
  }

  /** An accepted step. */
  void step()
  {
    auto attempt = stepper.attempt();
    ASSERT_TRUE(attempt.is_accepted());
    control.accept(attempt.record.newton_iterations);
    if (model.is_moving())
      model.move_geometry(std::move(attempt.points), control.step_size());
  }

  const Parameters<2> parameters;
  RunLog              run_log;
  StepControl         control;
  Model<2>            model;
  ImplicitStepper<2>  stepper;
};

/** That all numbers of two states are the same. */
void
expect_same(const State<2> &a, const State<2> &b)
{
  EXPECT_EQ(a.time, b.time);
  auto difference = a.displacement;
  difference -= b.displacement;
  EXPECT_EQ(difference.linfty_norm(), 0.);
  EXPECT_EQ(a.contact.tau, b.contact.tau);
  EXPECT_EQ(a.contact.jump, b.contact.jump);
  EXPECT_EQ(a.contact.pressure, b.contact.pressure);
  EXPECT_EQ(a.was_closed, b.was_closed);
  EXPECT_EQ(a.energies.strain, b.energies.strain);
  EXPECT_EQ(a.energies.dissipation, b.energies.dissipation);
  EXPECT_EQ(a.points.position, b.points.position);
  EXPECT_EQ(a.points.deformation_gradient, b.points.deformation_gradient);
  EXPECT_EQ(a.step_end.contact.tau, b.step_end.contact.tau);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (unsigned int i = 0; i < a.bodies.size(); ++i)
    EXPECT_EQ(a.bodies[i].level_set.values(), b.bodies[i].level_set.values());
}

void
expect_goes_on(const std::string &text)
{
  ModelRun first(text);
  first.step();
  first.step();
  const GatheredState<2> saved = first.model.gathered();

  ModelRun second(text);
  second.control.resume(first.control.record());
  second.model.restore(saved, second.control.time(), second.control.step_size(), "directory");
  EXPECT_EQ(second.model.state().displacement.size(), first.model.state().displacement.size());
  first.step();
  second.step();
  EXPECT_GT(first.model.state().energies.dissipation, 0.);
  expect_same(first.model.state(), second.model.state());
}

/** Leaves everything where it is, by steps of 0.2 at most, each at the second attempt. */
class StandStill : public Stepper<2>
{
public:
  StandStill(const StepControl &control, Model<2> &model, std::vector<double> &ends)
      : control(control)
      , model(model)
      , ends(ends)
  {
  }

  void begin() override
  {
    ends = {0.};
  }

  double largest_step() const override
  {
    return 0.2;
  }

  Attempt<2> attempt() override
  {
    Attempt<2> result;
    result.record.step = control.n_accepted() + 1;
    result.record.time = control.next_time();
    if (!is_second)
      return result;
    is_second         = false;
    auto &equilibrium = model.problem().equilibrium();
    auto  u = model.state().displacement, r = u;
    equilibrium.set_time(result.record.time, u);
    u = model.state().displacement;
    equilibrium.residual(u, model.state().contact, r);
    equilibrium.accept(u, model.state().contact);
    model.accept(u, result.record.time, {r, {}, {}});
    ends.push_back(model.state().time);
    result.outcome = Attempt<2>::Outcome::accepted;
    return result;
  }

  bool finds_another_way(const Attempt<2>::Outcome) override
  {
    return is_second = true;
  }

  StepperRecord recorded() const override
  {
    return {};
  }

  void resume(const StepperRecord &) override
  {
  }

private:
  const StepControl   &control;
  Model<2>            &model;
  std::vector<double> &ends; //!< of all steps, beginning with 0
  bool                 is_second = false;
};
} // namespace

TEST(Relaxation, BringsLooseBodiesNearTheEndOfTheStep)
{
  ModelRun direct(packing()), relaxed(packing());
  for (ModelRun *run : {&direct, &relaxed})
    run->stepper.begin();
  direct.step();

  Relaxation<2>  relaxation(relaxed.control, relaxed.model, relaxed.stepper, relaxed.run_log);
  const State<2> before = relaxed.model.state();
  ASSERT_TRUE(relaxation.may_help());
  ASSERT_TRUE(relaxation.run());
  EXPECT_TRUE(relaxation.is_pending());
  EXPECT_EQ(relaxed.model.state().time, relaxed.control.next_time());
  relaxation.go_back();
  EXPECT_FALSE(relaxation.is_pending());
  EXPECT_EQ(relaxed.model.state().time, before.time);
  for (unsigned int b = 0; b < before.bodies.size(); ++b)
    EXPECT_EQ(relaxed.model.state().bodies[b].level_set.values(),
              before.bodies[b].level_set.values());

  ASSERT_TRUE(relaxation.run());
  relaxed.step();
  relaxation.finish();
  const Energies &a = direct.model.state().energies, &b = relaxed.model.state().energies;
  // Work against the drag is external work and energy of transfer: only what is stored is alike.
  EXPECT_GT(a.stored(), 0.);
  EXPECT_NEAR(b.stored(), a.stored(), 2e-2 * a.stored());
  EXPECT_NEAR(b.balance_error(), 0., 1e-2 * a.external_work);
}

TEST(Relaxation, TakesAStepInWhichABodyGoesAsFarAsBefore)
{
  using Outcome = Attempt<2>::Outcome;
  ModelRun direct(packing());
  direct.stepper.begin();
  const auto before  = direct.model.state().points.position;
  const auto attempt = direct.stepper.attempt();
  ASSERT_TRUE(attempt.is_accepted());
  double motion = 0.;
  for (unsigned int i = 0; i < before.size(); ++i)
    motion = std::max(motion, attempt.points.position[i].distance(before[i]));

  const double h = direct.model.problem().grid.finest_size();
  ModelRun     slips(packing("set Largest motion = " + std::to_string(0.95 * motion / h) + "\n"));
  slips.stepper.begin();
  EXPECT_EQ(slips.stepper.attempt().outcome, Outcome::too_large);
  ASSERT_TRUE(slips.stepper.finds_another_way(Outcome::too_large)); // contact is closed first
  EXPECT_EQ(slips.stepper.attempt().outcome, Outcome::too_large);
  EXPECT_FALSE(slips.stepper.finds_another_way(Outcome::too_large)); // a shorter step might do
  EXPECT_EQ(slips.stepper.attempt().outcome, Outcome::too_large);
  ASSERT_TRUE(slips.stepper.finds_another_way(Outcome::too_large)); // it did not
  EXPECT_TRUE(slips.stepper.attempt().is_accepted());
  EXPECT_NEAR(slips.model.state().energies.stored(), direct.model.state().energies.stored(),
              2e-2 * direct.model.state().energies.stored());
}

TEST(Stepper, WhatNothingPressesInTheEndMayGoAsFarAsContactReaches)
{
  // Three quarters of 2 x Shift = 8 cells; what is pressed or held may go 2.
  const auto outcome = [](const double cells) {
    ModelRun run(pushed_disc(cells));
    run.stepper.begin();
    return run.stepper.attempt().outcome;
  };
  EXPECT_EQ(outcome(3.), Attempt<2>::Outcome::accepted);
  EXPECT_EQ(outcome(7.), Attempt<2>::Outcome::too_large);
}

TEST(Stepper, AnotherOneTakesTheStepsOfARun)
{
  const Directory     directory;
  std::vector<double> ends;
  Simulation<2>       simulation(
          ModelRun::read(block_on_bed("")), directory.path, MPI_COMM_WORLD, nullptr,
          [&](const Parameters<2> &, const StepControl &control, Model<2> &model, RunLog &) {
      return std::make_unique<StandStill>(control, model, ends);
    });
  simulation.run();
  ASSERT_EQ(ends.size(), 9u); // 0.25 is too large
  for (unsigned int i = 0; i < ends.size(); ++i)
    EXPECT_EQ(ends[i], 0.125 * i);
  EXPECT_EQ(simulation.get_model().state().displacement.linfty_norm(), 0.);
  // The velocity is in the checkpoint.
  const auto checkpoint = Checkpoint<2>::read(directory.path, MPI_COMM_WORLD);
  EXPECT_EQ(checkpoint.state.nodes.row_size(), 4u);
  RunLog     run_log{Log(MPI_COMM_WORLD, ""), {}, {}};
  const auto parameters = ModelRun::read(block_on_bed(""));
  Model<2>   again(parameters, 0.25, MPI_COMM_WORLD, run_log);
  again.restore(checkpoint.state, 1., 0.25, directory.path);
  auto difference = again.state().predictor.rates.velocity;
  difference -= simulation.get_model().state().predictor.rates.velocity;
  EXPECT_EQ(difference.linfty_norm(), 0.);
  EXPECT_GT(again.state().predictor.rates.velocity.linfty_norm(), 0.);
}

TEST(Stepper, FixedGeometryGoesOnFromGatheredState)
{
  expect_goes_on(block_on_bed(""));
}

TEST(Stepper, MovingGeometryGoesOnFromGatheredState)
{
  expect_goes_on(block_on_bed("set Update = every step\n"));
}

TEST(Stepper, RejectedStepLeavesState)
{
  ModelRun run(block_on_bed("set Update = every step\nset Largest motion = 0.12\n"));
  ASSERT_TRUE(run.control.reject()); // half a step is small enough
  run.model.begin_again(run.control.step_size());
  run.step();
  const State<2> before = run.model.state();
  // Of the same model, for a whole step.
  TimeParameters whole = run.parameters.time;
  whole.steps          = 1;
  StepControl        control(whole);
  ImplicitStepper<2> stepper(run.parameters, control, run.model, run.run_log);
  EXPECT_EQ(stepper.attempt().outcome, Attempt<2>::Outcome::too_large);
  expect_same(before, run.model.state());
  EXPECT_EQ(before.energies.external_work, run.model.state().energies.external_work);
}
