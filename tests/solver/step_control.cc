// The sequences of step lengths: halving, growing back, landing on the nominal times.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>
#include <scree/solver/step_control.h>

#include <cmath>
#include <limits>
#include <vector>

namespace scree
{
namespace
{
constexpr unsigned int easy = 3, hard = 20;

TimeParameters
times(const double end_time, const unsigned int steps, const double minimum_fraction)
{
  TimeParameters parameters;
  parameters.end_time              = end_time;
  parameters.steps                 = steps;
  parameters.minimum_step_fraction = minimum_fraction;
  return parameters;
}

TEST(StepControl, NominalStepsEndExactly)
{
  StepControl control(times(0.7, 7, 1. / 64));
  for (unsigned int k = 1; k <= 7; ++k)
    {
      ASSERT_FALSE(control.finished());
      EXPECT_EQ(control.step_fraction(), 1);
      EXPECT_NEAR(control.next_time(), 0.1 * k, 1e-15);
      EXPECT_NEAR(control.step_size(), 0.1, 1e-15);
      control.accept(easy);
      EXPECT_TRUE(control.at_nominal_time());
    }
  EXPECT_TRUE(control.finished());
  EXPECT_EQ(control.time(), 0.7);
  EXPECT_EQ(control.n_accepted(), 7u);
}

TEST(StepControl, AfterTheLastOfUnequalStepsTheNextIsAsLong)
{
  TimeParameters parameters = times(2., 2, 1. / 64);
  parameters.nominal_times  = {0.5, 2.};
  StepControl control(parameters);
  for (const double size : {0.5, 1.5, 1.5})
    {
      EXPECT_EQ(control.step_size(), size);
      if (!control.finished())
        control.accept(easy);
    }
  EXPECT_TRUE(control.finished());
}

TEST(StepControl, HalvesAndGrowsBackAfterTwoEasySteps)
{
  StepControl control(times(3, 3, 1. / 8));
  EXPECT_TRUE(control.reject());
  EXPECT_TRUE(control.reject());
  std::vector<double> fractions, ends;
  while (!control.finished())
    {
      fractions.push_back(control.step_fraction());
      control.accept(easy);
      ends.push_back(control.time());
    }
  // Two quarters; the wish for a half is met (1/2 to 1), and the second half step grows to one.
  EXPECT_EQ(fractions, (std::vector<double>{0.25, 0.25, 0.5, 0.5, 0.5, 1}));
  EXPECT_EQ(ends, (std::vector<double>{0.25, 0.5, 1, 1.5, 2, 3}));
  EXPECT_EQ(control.n_rejected(), 2u);
}

TEST(StepControl, HardStepsDoNotGrow)
{
  StepControl control(times(2, 2, 1. / 8));
  control.reject();
  for (unsigned int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(control.step_fraction(), 0.5);
      control.accept(k % 2 == 0 ? easy : hard);
    }
  EXPECT_TRUE(control.finished());
}

TEST(StepControl, StepsThatWouldPassANominalTimeAreShortened)
{
  StepControl control(times(2, 2, 1. / 8));
  control.reject();
  control.reject();
  control.reject();
  control.accept(easy); // 1/8
  control.accept(easy); // 2/8, the length becomes 1/4
  control.accept(easy); // 4/8
  EXPECT_TRUE(control.reject());
  EXPECT_EQ(control.step_fraction(), 1. / 8);
  control.accept(easy); // 5/8
  control.accept(easy); // 6/8, the length becomes 1/4
  control.accept(easy); // 8/8
  EXPECT_EQ(control.time(), 1);
  EXPECT_TRUE(control.at_nominal_time());
  control.accept(easy); // 1 + 2/8, the length becomes 1/2
  control.accept(easy); // 1 + 6/8
  EXPECT_EQ(control.time(), 1.75);
  EXPECT_EQ(control.step_fraction(), 0.25);
  control.accept(easy);
  EXPECT_TRUE(control.finished());
}

TEST(StepControl, GivesUpAtTheMinimum)
{
  StepControl control(times(1, 1, 0.25));
  EXPECT_TRUE(control.reject());
  EXPECT_TRUE(control.reject());
  EXPECT_EQ(control.step_fraction(), 0.25);
  EXPECT_FALSE(control.reject());
  EXPECT_EQ(control.n_rejected(), 3u);

  // 0.3 is not a power of two: no step is smaller than it.
  StepControl other(times(1, 1, 0.3));
  EXPECT_TRUE(other.reject());
  EXPECT_FALSE(other.reject());

  StepControl never(times(1, 1, 1));
  EXPECT_FALSE(never.reject());
}

TEST(StepControl, StepsAreShortenedWithoutARejection)
{
  StepControl control(times(1., 2, 1. / 8));
  EXPECT_TRUE(control.shorten(0.5));
  EXPECT_EQ(control.next_time(), 0.5);
  EXPECT_TRUE(control.shorten(0.2));
  EXPECT_EQ(control.next_time(), 0.125);
  EXPECT_FALSE(control.shorten(0.01));
  EXPECT_EQ(control.n_rejected(), 0u);
}

/** Steps by error, nominal ones of length 1. */
TimeParameters
times_by_error(const unsigned int steps)
{
  TimeParameters parameters        = times(steps, steps, 1. / 64);
  parameters.local_error           = 1e-3;
  parameters.maximum_step_fraction = 4.;
  return parameters;
}

constexpr StepError none = {0., 2}, too_large = {100., 2}, right = {0.5, 2};

TEST(StepControl, StepsByErrorBecomeLongAndEndWithTheRun)
{
  StepControl         control(times_by_error(20));
  std::vector<double> sizes;
  while (!control.finished())
    {
      sizes.push_back(control.step_size());
      control.accept(easy, none);
    }
  // Double after two steps, at most 4 nominal ones; no small one is left in the end.
  EXPECT_EQ(sizes, (std::vector<double>{1, 1, 2, 4, 4, 4, 4}));
  EXPECT_EQ(control.time(), 20.);
}

TEST(StepControl, StepsByErrorAreShortenedByTheirError)
{
  StepControl control(times_by_error(20));
  EXPECT_TRUE(control.reject(too_large));
  EXPECT_NEAR(control.step_size(), 0.2, 1. / 1024);
  EXPECT_TRUE(control.reject(too_large));
  EXPECT_TRUE(control.reject(too_large));
  EXPECT_TRUE(control.is_smallest());
  EXPECT_EQ(control.step_size(), 1. / 64);
  EXPECT_FALSE(control.reject(too_large));
  EXPECT_EQ(control.n_rejected(), 4u);
  control.accept(easy, none);
  control.accept(hard, none);
  EXPECT_EQ(control.step_size(), 1. / 64);
  control.accept(easy, none);
  control.accept(easy, none);
  EXPECT_EQ(control.step_size(), 1. / 32);
  control.accept(easy); // The error is not known.
  EXPECT_EQ(control.step_size(), 1. / 32);
}

TEST(StepControl, StepsByErrorEndWhereStagesDo)
{
  TimeParameters parameters = times_by_error(6);
  parameters.nominal_times  = {0.5, 1., 2., 3., 4., 5.};
  parameters.end_time       = 5.;
  parameters.stage_ends     = {2, 6};
  parameters.static_steps   = 2;
  StepControl         control(parameters);
  std::vector<double> ends;
  while (!control.finished())
    {
      control.accept(easy, none);
      ends.push_back(control.time());
    }
  // The first stage has no error, and nominal steps. Two of three left would leave one.
  EXPECT_EQ(ends, (std::vector<double>{0.5, 1., 2., 3.5, 5.}));
}

TEST(StepControl, AStepByErrorEndsBeforeAnEvent)
{
  StepControl control(times_by_error(20));
  for (unsigned int n = 0; n < 4; ++n)
    control.accept(easy, none);
  const double begin = control.time();
  EXPECT_FALSE(control.end_before(5., true));
  EXPECT_FALSE(control.end_before(0.5 / 64, true));
  EXPECT_TRUE(control.end_before(0.7001, true));
  EXPECT_LE(control.step_size(), 0.7001);
  EXPECT_GT(control.step_size(), 0.7001 - 1. / 1024);
  control.accept(easy, none);
  EXPECT_NEAR(control.time(), begin + 0.7, 1. / 1024);
  EXPECT_EQ(control.step_size(), 1.); // A nominal one, whatever it was before.
}

TEST(StepControl, StepsByErrorGoOnFromTheirRecord)
{
  StepControl control(times_by_error(20)), other(times_by_error(20));
  for (const double ratio : {0.5, 0.01, 0.2, 0.7})
    control.accept(easy, StepError{ratio, 2});
  other.resume(control.record());
  for (unsigned int n = 0; n < 5; ++n)
    {
      EXPECT_EQ(other.next_time(), control.next_time());
      control.accept(easy, right);
      other.accept(easy, right);
    }
  StepControlRecord damaged = control.record();
  damaged.last_ratio        = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(other.resume(damaged), UserError);
}

TEST(TimeParameters, AreReadAndChecked)
{
  ParameterFile  good = ParameterFile::from_string("set End time = 2.5\nset Steps = 4\n");
  TimeParameters parameters;
  parameters.declare(good.root());
  good.check();
  EXPECT_EQ(parameters.end_time, 2.5);
  EXPECT_EQ(parameters.steps, 4u);

  for (const char *wrong :
       {"set Steps = 0", "set End time = 0", "set Minimum step fraction = 2", "set Steps = -3"})
    {
      ParameterFile bad = ParameterFile::from_string(wrong);
      TimeParameters().declare(bad.root());
      EXPECT_THROW(bad.check(), UserError) << wrong;
    }
}
/** The times of the remaining steps, of which every fifth takes many iterations. */
std::vector<double>
remaining_times(StepControl &control)
{
  std::vector<double> times;
  while (!control.finished())
    {
      if (times.size() % 5 == 4 && control.step_fraction() == 1.)
        control.reject();
      times.push_back(control.next_time());
      control.accept(times.size() % 5 == 0 ? hard : easy);
    }
  return times;
}

TEST(StepControl, GoesOnFromItsRecord)
{
  const auto  parameters = times(0.7, 7, 1. / 64);
  StepControl control(parameters);
  for (unsigned int i = 0; i < 3; ++i)
    control.reject();
  for (unsigned int i = 0; i < 6; ++i)
    control.accept(i == 4 ? hard : easy);
  StepControl other(parameters);
  other.resume(control.record());
  EXPECT_EQ(other.time(), control.time());
  EXPECT_EQ(other.n_accepted(), 6u);
  EXPECT_EQ(other.n_rejected(), 3u);
  EXPECT_EQ(remaining_times(other), remaining_times(control));
  EXPECT_EQ(other.time(), 0.7);
}

TEST(StepControl, ParametersMayChangeBetweenRecordAndResumption)
{
  StepControl control(times(0.7, 7, 1. / 64));
  while (!control.finished())
    control.accept(easy);
  StepControl longer(times(1.4, 14, 1. / 64));
  longer.resume(control.record());
  EXPECT_NEAR(longer.time(), 0.7, 1e-15);
  EXPECT_NEAR(longer.next_time(), 0.8, 1e-15);
  // After a failure with the smallest step, a smaller one may be allowed.
  StepControl failed(times(0.7, 7, 0.5));
  failed.accept(easy);
  EXPECT_TRUE(failed.reject());
  EXPECT_FALSE(failed.reject());
  StepControl finer(times(0.7, 7, 1. / 64));
  finer.resume(failed.record());
  EXPECT_NEAR(finer.next_time(), 0.15, 1e-15);
  EXPECT_TRUE(finer.reject());

  StepControl other_steps(times(0.7, 5, 1.));
  EXPECT_THROW(other_steps.resume(failed.record()), UserError);
  StepControl over(times(0.05, 1, 1.));
  EXPECT_THROW(over.resume(failed.record()), UserError);
}

TEST(StepControl, ARecordOfNoTimeIsRefused)
{
  auto parameters          = times(1., 2, 1.);
  parameters.nominal_times = {0.5, 1.};
  for (const double time : {-1., -1e300, std::numeric_limits<double>::quiet_NaN()})
    {
      StepControl       control(parameters);
      StepControlRecord record = control.record();
      record.time              = time;
      EXPECT_THROW(control.resume(record), UserError);
    }
}
} // namespace
} // namespace scree
