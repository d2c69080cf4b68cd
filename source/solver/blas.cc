#include <scree/solver/blas.h>

#include <dlfcn.h>

namespace scree
{
std::string
outdated_blas_kernels()
{
#if defined(__x86_64__)
  using Name = char *();
  if (auto *core_name = reinterpret_cast<Name *>(dlsym(RTLD_DEFAULT, "openblas_get_corename")))
    if (std::string core = core_name(); core == "Prescott" && __builtin_cpu_supports("avx2"))
      return core;
#endif
  return "";
}
} // namespace scree
