// Stages of loading: what they make of the formulas of rigid bodies and of the time axis, and what
// is refused.
#include <gtest/gtest.h>

#include <scree/application/parameters.h>
#include <scree/application/stage_control.h>
#include <scree/base/exceptions.h>
#include <scree/base/expression.h>

#include <limits>
#include <string>

using namespace scree;

namespace
{
/** A rigid wall, and a rigid lid driven by force, with what is written in Stages and elsewhere. */
Parameters<2>
staged(const std::string &stages, const std::string &rest = "")
{
  const auto half_space = [](const std::string &material) {
    return "\n    set Material = " + material + R"(
    subsection Shape
      set Type = half space
      set Point = 0, 0
      set Normal = 1, 0
    end
)";
  };
  ParameterFile file = ParameterFile::from_string(R"(
subsection Grid
  set Lower corner = -1, -1
  set Upper corner = 1, 1
  set Cells        = 2, 2
end
subsection Materials
  set Names = rigid, soft
  subsection rigid
    set Law = rigid
  end
  subsection soft
    set Young's modulus = 1
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  set Names = wall, lid, block
  subsection wall)" + half_space("rigid") + R"(
    subsection Motion
      set Displacement x = 0.5*t
    end
  end
  subsection lid)" + half_space("rigid") + R"(
    subsection Motion
      set Force y = 0
    end
  end
  subsection block)" + half_space("soft") + R"(
  end
end
subsection Stages
)" + stages + "\nend\n" + rest);
  Parameters<2> result;
  result.declare(file);
  file.check();
  return result;
}

/** What drives the wall and the lid in all stages. */
std::vector<BodyParameters<2>>
driven(const Parameters<2> &p, const StageRecord<2> &record = {})
{
  auto result = p.bodies;
  set_motions(p.stages, record, result);
  return result;
}

const std::string press_hold_shear = R"(
  set Names = press, hold, shear
  subsection press
    set Duration = 2
    set Steps    = 4
    set Bodies   = wall, lid
    subsection wall
      set Displacement x = 0.1*t^2
    end
    subsection lid
      set Force y = -3*t
    end
  end
  subsection hold
    set Duration = 1
  end
  subsection shear
    set Duration = 0.5
    set Steps    = 2
    set Bodies   = wall
    subsection wall
      set Displacement x = -0.4*t
      set Displacement y = sqrt(t)
    end
  end
)";

double
value(const std::string &formula, const double time)
{
  return Expression<2>(formula, 1, "test").value(dealii::Point<2>(), time);
}

TEST(Stages, FollowOneAnotherFromWhereTheLastEnded)
{
  const Parameters<2> p      = staged(press_hold_shear);
  const auto          bodies = driven(p);
  const auto         &wall   = bodies[0].motion.motion;
  const auto         &lid    = bodies[1].motion.load;
  // Added to 0.5 t of section Bodies.
  EXPECT_NEAR(value(wall[0], 1.), 0.5 + 0.1, 1e-14);
  EXPECT_NEAR(value(wall[0], 2.), 1. + 0.4, 1e-14);
  EXPECT_NEAR(value(wall[0], 2.7), 1.35 + 0.4, 1e-14);
  EXPECT_NEAR(value(wall[0], 3.25), 1.625 + 0.4 - 0.1, 1e-14);
  EXPECT_EQ(value(wall[1], 2.9), 0.);
  EXPECT_NEAR(value(wall[1], 3.25), 0.5, 1e-14);
  EXPECT_NEAR(value(lid[1], 1.), -3., 1e-14);
  EXPECT_NEAR(value(lid[1], 3.5), -6., 1e-14);
  EXPECT_TRUE(bodies[1].motion.motion[1].empty());
}

const std::string push_keep_lead = R"(
  set Names = push, bear, lead
  subsection push
    set Duration = 2
    set Steps    = 4
    set Until    = abs(lid.force_y) > 3
    set Bodies   = wall
    subsection wall
      set Displacement x = -t
    end
  end
  subsection bear
    set Bodies = wall, lid
    subsection wall
      set Force x = keep
    end
    subsection lid
      set Displacement y = to -2
    end
  end
  subsection lead
    set Duration = 0.5
    set Bodies   = wall, lid
    subsection wall
      set Displacement x = 2*t
    end
    subsection lid
      set Force y = to 10
    end
  end
)";

TEST(Stages, TurnFromMotionToLoadAndBack)
{
  const Parameters<2> p = staged(push_keep_lead);
  // Before it is known what the second one finds, only the first one drives.
  auto bodies = driven(p);
  EXPECT_NEAR(value(bodies[0].motion.motion[0], 3.5), 0.5 * 3.5 - 2., 1e-14);
  EXPECT_EQ(bodies[1].motion.load[1], "0");
  StageRecord<2> record;
  record.ends   = {1.2};
  record.starts = {{}, {{"wall", {{-7., 0., 0.}}}, {"lid", {{0., -1., 0.}}}}};
  bodies        = driven(p, record);
  EXPECT_TRUE(bodies[0].motion.motion[0].empty());
  EXPECT_NEAR(value(bodies[0].motion.load[0], 1.5), -7., 1e-14);
  EXPECT_TRUE(bodies[1].motion.load[1].empty());
  EXPECT_NEAR(value(bodies[1].motion.motion[1], 1.7), -1.5, 1e-14);
  record.ends.push_back(2.2);
  record.starts.push_back({{"wall", {{-0.3, 0., 0.}}}, {"lid", {{0., 4., 0.}}}});
  bodies = driven(p, record);
  EXPECT_TRUE(bodies[0].motion.load[0].empty());
  EXPECT_NEAR(value(bodies[0].motion.motion[0], 2.5), -0.3 + 2. * 0.3, 1e-14);
  EXPECT_NEAR(value(bodies[1].motion.load[1], 2.45), 7., 1e-14);
  EXPECT_NEAR(value(bodies[1].motion.load[1], 2.7), 10., 1e-14);
}

TEST(Stages, EndWhereTheyAreStopped)
{
  Parameters<2> p = staged(push_keep_lead);
  EXPECT_EQ(p.time.nominal_times, (std::vector<double>{0.5, 1., 1.5, 2., 3., 3.5}));
  StepControl control(p.time);
  control.accept(1);
  EXPECT_FALSE(control.cut(0.999));
  EXPECT_TRUE(control.cut(0.25)); // Once, in steps of 1/64.
  EXPECT_EQ(control.next_time(), 0.5 + 16. / 64. * 0.5);
  control.accept(1);
  StageRecord<2> record;
  record.ends = {control.time()};
  set_times(p.stages, record, p.time);
  EXPECT_EQ(p.time.nominal_times, (std::vector<double>{0.5, 0.625, 1.625, 2.125}));
  EXPECT_EQ(p.time.end_time, 2.125);
  control.change_times(p.time);
  EXPECT_EQ(control.time(), 0.625);
  EXPECT_EQ(control.next_time(), 1.625);
  // It holds what it had where a stage ended as planned.
  EXPECT_NEAR(value(driven(p, record)[0].motion.motion[0], 1.), 0.5 - 0.625, 1e-14);
}

TEST(Stages, AreLedToTheirStops)
{
  const Parameters<2> p = staged(push_keep_lead);
  StageControl<2>     control(p.stages, {}, MPI_COMM_SELF);
  control.require_known({"lid.force_y", "wall.force_x"});
  EXPECT_THROW(control.require_known({"wall.force_x"}), UserError);
  EXPECT_EQ(control.number(), 1u);
  EXPECT_TRUE(control.has_stop());
  EXPECT_EQ(control.observe({{"lid.force_y", -7.}}, 0.5), 0.5); // Nothing is known of t = 0.
  EXPECT_EQ(control.observe({{"lid.force_y", -1.}}, 0.25), 1.);
  EXPECT_FALSE(control.accept(0.25));
  EXPECT_EQ(control.observe({{"lid.force_y", -5.}}, 0.75), 0.5);
  EXPECT_EQ(control.observe({{"lid.force_y", -2.99}}, 0.5), 1.); // Within 1 % of 4.
  EXPECT_TRUE(control.accept(0.5));
  EXPECT_TRUE(control.is_reached());
  control.begin_next({}, {});
  EXPECT_EQ(control.number(), 2u);
  EXPECT_FALSE(control.has_stop());
  EXPECT_EQ(control.observe({}, 1.5), 1.);
  EXPECT_TRUE(control.accept(1.5));
  EXPECT_FALSE(control.is_reached());
}

TEST(StopRelation, ComparesFormulas)
{
  const std::map<std::string, double> values
    = {{"p", 3.}, {"q", 1.}, {"side", 5.}, {"left.force_x", -2.}, {"side-left.force_x", -8.}};
  const auto margin
    = [&](const std::string &text) { return StopRelation(text, "").margin(values); };
  EXPECT_EQ(margin("p > 2"), 1.);
  EXPECT_EQ(margin("p<=2e0"), -1.);
  EXPECT_EQ(margin("q/p >= 1/3"), 0.);
  EXPECT_EQ(margin("abs(side-left.force_x) > 10"), -2.);
  EXPECT_EQ(margin("side - left.force_x > 1"), 6.);
  EXPECT_EQ(margin("1e-1*p < 1"), 1. - 0.1 * 3.);
  EXPECT_TRUE(std::isnan(margin("q/(p-3) > 1") - margin("q/(p-3) > 1")));
  for (const std::string wrong : {"p", "p > 1 > 0", "> 2", "p = 2", "p <"})
    EXPECT_THROW(StopRelation(wrong, ""), UserError) << wrong;
  for (const std::string wrong : {"pp > 1", "left.force_y > 1", "p + > 1"})
    EXPECT_THROW(StopRelation(wrong, "").require_known({"p", "left.force_x"}), UserError) << wrong;
}

TEST(Stages, HaveStepsOfTheirOwn)
{
  const Parameters<2> p = staged(press_hold_shear);
  EXPECT_EQ(p.time.end_time, 3.5);
  StepControl         control(p.time);
  std::vector<double> ends;
  while (!control.finished())
    {
      control.accept(1);
      ends.push_back(control.time());
    }
  EXPECT_EQ(ends, (std::vector<double>{0.5, 1., 1.5, 2., 3., 3.25, 3.5}));
}

TEST(Stages, GoOnFromTheRecordOfEveryStep)
{
  const Parameters<2> p = staged(press_hold_shear);
  StepControl         control(p.time);
  while (!control.finished())
    {
      control.reject();
      control.accept(1); // Now within a nominal step.
      StepControl resumed(p.time);
      resumed.resume(control.record());
      EXPECT_EQ(resumed.time(), control.time());
      if (!control.finished())
        {
          EXPECT_EQ(resumed.next_time(), control.next_time());
        }
      control.accept(1);
    }
}

TEST(Stages, ChangeFrictionFromTheirBeginningOn)
{
  const std::string   laws = "subsection Contact\nset Names = grains\nsubsection grains\n"
                             "set Friction coefficient = 0\nend\nend\n";
  const Parameters<2> p    = staged(
       "set Names = a, b, c\nsubsection b\nsubsection Contact\nset Names = grains\nsubsection grains\n"
          "set Friction coefficient = 0.4\nend\nend\nend",
       laws);
  StageRecord<2> record;
  auto           contact = p.contact;
  EXPECT_FALSE(set_friction(p.stages, record, contact));
  EXPECT_EQ(contact.laws[0].friction_coefficient, 0.);
  record.ends.push_back(1.);
  EXPECT_TRUE(set_friction(p.stages, record, contact));
  record.ends.push_back(2.);
  EXPECT_FALSE(set_friction(p.stages, record, contact));
  EXPECT_EQ(contact.laws[0].friction_coefficient, 0.4);
}

TEST(Stages, RefuseTheRecordOfAnotherRun)
{
  const Parameters<2> p      = staged(press_hold_shear);
  const auto          accept = [&p](const StageRecord<2> &record) {
    EXPECT_NO_THROW(StageControl<2>(p.stages, record, MPI_COMM_SELF));
  };
  const auto refuse = [&p](const StageRecord<2> &record) {
    EXPECT_THROW(StageControl<2>(p.stages, record, MPI_COMM_SELF), UserError);
  };
  StageRecord<2> record;
  accept(record);
  record.ends = {2., 3.};
  record.starts.resize(3);
  record.starts[2]["wall"] = {{0., 1., 0.}};
  accept(record);

  StageRecord<2> wrong = record;
  wrong.ends           = {2., 3., 3.5, 4.};
  refuse(wrong);
  wrong.ends = {3., 2.};
  refuse(wrong);
  wrong.ends = {std::numeric_limits<double>::quiet_NaN()};
  refuse(wrong);
  wrong = record;
  wrong.starts[2].clear();
  refuse(wrong);
  wrong                      = record;
  wrong.starts[2]["wall"][1] = std::numeric_limits<double>::infinity();
  refuse(wrong);
  wrong = record;
  wrong.starts.resize(4);
  refuse(wrong);
  wrong         = record;
  wrong.lengths = {1., 1., 1.};
  refuse(wrong);
}

TEST(Stages, WithoutThemNothingChanges)
{
  const Parameters<2> p = staged("");
  EXPECT_EQ(p.bodies[0].motion.motion[0], "0.5*t");
  EXPECT_TRUE(p.time.nominal_times.empty());
}

/** What is told of a stage in which `line` is said of the body. */
std::string
complaint(const std::string &body, const std::string &line, const std::string &rest = "")
{
  try
    {
      staged("set Names = a\nsubsection a\nset Bodies = " + body + "\nsubsection " + body + "\n"
               + line + "\nend\nend",
             rest);
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

TEST(Stages, RefuseWhatMakesNoSense)
{
  const struct
  {
    std::string body, line, rest, complaint;
  } wrong[]
    = {{"wal", "set Displacement x = t", "", "there is no body 'wal'; did you mean 'wall'?"},
       {"block", "set Displacement x = t", "", "the body 'block' is deformable"},
       {"wall", "", "", "nothing is said of the body"},
       {"wall", "set Displacement x = 0.2", "", "'0.2' is not zero at t = 0"},
       {"wall", "set Displacement x = log(t)", "", "is not zero at t = 0"},
       {"wall", "set Displacement x = t/(t - 1)", "", "is no finite number at the end"},
       {"wall", "set Displacement x = 2*s", "", "s"},
       {"wall", "set Displacement x = table(a.csv)", "", "a table in a stage"},
       {"wall", "set Force x = t\nset Displacement x = t", "", "Displacement x is given too"},
       {"wall", "set Force x = to much", "", "'much' is no number"},
       {"wall", "set Displacement x = t", "subsection Time\nset Steps = 3\nend\n",
        "the stages have times and steps of their own"}};
  for (const auto &w : wrong)
    {
      const std::string told = complaint(w.body, w.line, w.rest);
      EXPECT_NE(told.find(w.complaint), std::string::npos) << w.line << ": " << told;
      EXPECT_NE(told.find(w.rest.empty() ? "Stages" : "Time"), std::string::npos) << told;
    }
  EXPECT_EQ(complaint("wall", "set Displacement x = t"), "");
  const struct
  {
    std::string stages, rest, complaint;
  } of_stages[]
    = {{"set Names = a\nsubsection a\nset Reset = true\nend", "", "has nothing to reset"},
       {"set Names = a, b\nsubsection b\nset Reset = true\nend", "", "on a geometry that stays"},
       {"set Names = a\nsubsection a\nset Until = p\nend", "", "is not one comparison"},
       {"set Names = a\nsubsection a\nsubsection Contact\nset Names = x\nend\nend", "",
        "there is no contact law 'x'"},
       {"set Names = a, b\nsubsection b\nset Reset = true\nend",
        "subsection Moving geometry\nset Update = every step\nend\nsubsection Contact\n"
        "set Names = glue\nsubsection glue\nset Law = tied\nend\nend\n",
        "takes gaps from the start"}};
  for (const auto &w : of_stages)
    try
      {
        staged(w.stages, w.rest);
        ADD_FAILURE() << w.complaint;
      }
    catch (const UserError &error)
      {
        EXPECT_NE(std::string(error.what()).find(w.complaint), std::string::npos) << error.what();
      }
}
} // namespace
