#include <scree/application/implicit_stepper.h>

namespace scree
{
template <int dim>
std::unique_ptr<Stepper<dim>>
make_stepper(const Parameters<dim> &parameters, const StepControl &step_control, Model<dim> &model,
             RunLog &run_log)
{
  return std::make_unique<ImplicitStepper<dim>>(parameters, step_control, model, run_log);
}

template std::unique_ptr<Stepper<2>> make_stepper(const Parameters<2> &, const StepControl &,
                                                  Model<2> &, RunLog &);
template std::unique_ptr<Stepper<3>> make_stepper(const Parameters<3> &, const StepControl &,
                                                  Model<3> &, RunLog &);
} // namespace scree
