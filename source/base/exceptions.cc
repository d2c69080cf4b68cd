#include <scree/base/exceptions.h>

namespace scree
{
namespace
{
std::string
message(const std::string &where, const std::string &what, const std::string &remedy)
{
  return where + ": " + what + (remedy.empty() ? "" : "\n  remedy: " + remedy);
}
} // namespace

UserError::UserError(const std::string &where, const std::string &what, const std::string &remedy)
    : std::runtime_error(message(where, what, remedy))
{
}

void
require(const bool condition, const std::string &where, const std::string &what,
        const std::string &remedy)
{
  if (!condition)
    throw UserError(where, what, remedy);
}
} // namespace scree
