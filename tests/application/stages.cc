// Stages of loading: what they make of the formulas of rigid bodies and of the time axis, and what
// is refused.
#include <gtest/gtest.h>

#include <scree/application/parameters.h>
#include <scree/base/exceptions.h>
#include <scree/base/expression.h>

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
  const Parameters<2> p    = staged(press_hold_shear);
  const auto         &wall = p.bodies[0].motion.motion;
  const auto         &lid  = p.bodies[1].motion.load;
  // Added to 0.5 t of section Bodies.
  EXPECT_NEAR(value(wall[0], 1.), 0.5 + 0.1, 1e-14);
  EXPECT_NEAR(value(wall[0], 2.), 1. + 0.4, 1e-14);
  EXPECT_NEAR(value(wall[0], 2.7), 1.35 + 0.4, 1e-14);
  EXPECT_NEAR(value(wall[0], 3.25), 1.625 + 0.4 - 0.1, 1e-14);
  EXPECT_EQ(value(wall[1], 2.9), 0.);
  EXPECT_NEAR(value(wall[1], 3.25), 0.5, 1e-14);
  EXPECT_NEAR(value(lid[1], 1.), -3., 1e-14);
  EXPECT_NEAR(value(lid[1], 3.5), -6., 1e-14);
  EXPECT_TRUE(p.bodies[1].motion.motion[1].empty());
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
        EXPECT_EQ(resumed.next_time(), control.next_time());
      control.accept(1);
    }
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
       {"wall", "set Force x = t", "", "gives the body's motion, not its load"},
       {"lid", "set Displacement y = t", "", "gives the body's load, not its motion"},
       {"wall", "set Displacement x = t", "subsection Time\nset Steps = 3\nend\n",
        "the stages have times and steps of their own"}};
  for (const auto &w : wrong)
    {
      const std::string told = complaint(w.body, w.line, w.rest);
      EXPECT_NE(told.find(w.complaint), std::string::npos) << w.line << ": " << told;
      EXPECT_NE(told.find(w.rest.empty() ? "Stages" : "Time"), std::string::npos) << told;
    }
  EXPECT_EQ(complaint("wall", "set Displacement x = t"), "");
}
} // namespace
