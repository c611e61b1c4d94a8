// Errors that a user sees, and the exit code each one ends with (SPEC.md, "Exit codes").
#pragma once

#include <stdexcept>
#include <string>

namespace servoid {

enum class ExitCode { done = 0, defect = 1, usage = 2, bad_file = 3, refused = 4, bus_fault = 5 };

// Base of every error we raise on purpose. what() is the whole message, one line, ready to print.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

// A file that cannot be read or is wrong. Message: `file:line: what is wrong, what was expected`;
// line 0 leaves the line out (the whole file is meant).
class FileError : public Error {
  public:
    FileError(const std::string& file, long line, const std::string& reason)
        : Error(ExitCode::bad_file, line > 0 ? file + ":" + std::to_string(line) + ": " + reason
                                             : file + ": " + reason) {}
};

// Data that is well formed but cannot answer the question: the reason, and what to record instead.
class Refusal : public Error {
  public:
    Refusal(const std::string& reason, const std::string& record_instead)
        : Error(ExitCode::refused, reason + "; record instead: " + record_instead), reason_(reason),
          record_instead_(record_instead) {}
    const std::string& reason() const { return reason_; }
    const std::string& record_instead() const { return record_instead_; }

  private:
    std::string reason_, record_instead_;
};

// Wrong usage of the command line.
class UsageError : public Error {
  public:
    explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

} // namespace servoid
