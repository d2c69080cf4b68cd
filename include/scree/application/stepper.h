#pragma once

#include <scree/application/model.h>
#include <scree/output/run_report.h>
#include <scree/solver/step_control.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace scree
{
/** What came of an attempt of a step. */
template <int dim>
struct Attempt
{
  enum class Outcome
  {
    accepted,
    unsolved,   //!< no equilibrium was found
    too_large,  //!< one was found, too far for the moving geometry
    inaccurate, //!< one was found, with too large an error
    interrupted
  };

  Outcome                  outcome = Outcome::unsolved;
  StepRecord               record;
  MaterialPoints<dim>      points; //!< after an accepted step on a moving geometry
  std::optional<StepError> error;  //!< of a step that was accepted or inaccurate; none: not known

  bool is_accepted() const
  {
    return outcome == Outcome::accepted;
  }
};

/** Where a step by error should end. */
struct StepEvent
{
  double      time_left = std::numeric_limits<double>::infinity(); //!< until then
  std::string pair; //!< whose contact begins there; empty: the geometry moves as far as it may
};

/** What a Stepper keeps from step to step beside the State. */
struct StepperRecord
{
  bool   is_second_attempt = false; //!< how steps are tried, see Equilibrium::set_second_attempt()
  double largest_speed     = 0.;    //!< of a body so far, see StepAccuracy [L/time]

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &is_second_attempt &largest_speed;
  }
};

/**
 * Takes the bodies of a model from one load step to the next. The state of the model changes if a
 * step is accepted and not before; then Model::move_geometry() is next on a moving geometry. All
 * functions are collective.
 */
template <int dim>
class Stepper
{
public:
  virtual ~Stepper() = default;

  /** What has to be done before the first step of a run, also of one that is resumed. */
  virtual void begin() = 0;

  /** The largest step of the present state [time]; infinity: any. */
  virtual double largest_step() const = 0;

  /** Where the step should end that the step control says. */
  virtual StepEvent next_event() const
  {
    return {};
  }

  /** One attempt of the step that the step control says. */
  virtual Attempt<dim> attempt() = 0;

  /**
   * After an attempt that was unsolved or too large: whether there is another way to take the whole
   * step, which the next attempt() takes.
   *
   * @throws UserError if there cannot be a solution
   */
  virtual bool finds_another_way(const typename Attempt<dim>::Outcome outcome) = 0;

  virtual StepperRecord recorded() const                    = 0;
  virtual void          resume(const StepperRecord &record) = 0;
};

/** Makes a Stepper; all arguments outlive it. */
template <int dim>
using StepperFactory = std::function<std::unique_ptr<Stepper<dim>>(
  const Parameters<dim> &, const StepControl &, Model<dim> &, RunLog &)>;

/** The one that the parameters ask for. */
template <int dim>
std::unique_ptr<Stepper<dim>> make_stepper(const Parameters<dim> &parameters,
                                           const StepControl &step_control, Model<dim> &model,
                                           RunLog &run_log);
} // namespace scree
