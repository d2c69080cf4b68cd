#pragma once

#include <stdexcept>
#include <string>

namespace scree
{
/**
 * An error of the user's input or of what was asked for, told in one message: where, what was
 * found, what is allowed, and what to do. `main` prints it without a stack trace and ends the run
 * with code 1.
 */
class UserError : public std::runtime_error
{
public:
  /**
   * @param where  the section, key or file concerned, e.g. "Bodies/block/Shape"
   * @param what   what was found there
   * @param remedy what to do about it (may be empty)
   */
  UserError(const std::string &where, const std::string &what, const std::string &remedy = "");
};

/**
 * A body is torn, or so thin that the grid no longer holds it: a step that goes there may be tried
 * in another way. Thrown on all processes.
 */
class TornBody : public UserError
{
public:
  using UserError::UserError;
};

/** Throws UserError(where, what, remedy) unless `condition` holds. */
void require(const bool condition, const std::string &where, const std::string &what,
             const std::string &remedy = "");
} // namespace scree
