// Standard input, output and error as a program finds them: they may be closed, and what is written may not arrive.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace gamut {

/// Standard input cannot be read; what() says why.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Puts the empty device in the place of a standard stream that is closed, so that no file takes its place.
void occupyStandardStreams();

/// All that standard input gives until its end. Throws ReadError.
std::string readIn();

/// Writes to standard output. Throws WriteError if it cannot be written to.
void sayOut(std::string_view text);

/// Nothing that was said on standard output is held back any more. Throws WriteError if it did not arrive.
void flushOut();

}  // namespace gamut
