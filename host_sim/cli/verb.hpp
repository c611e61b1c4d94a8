// One verb of the command line and its arguments. The headers of CLI11 take longer to compile than
// any verb: only verb.cpp and app.cpp include them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace servoid::cli {

// What an argument must be; anything else is a usage error.
class Argument {
  public:
    explicit Argument(CLI::Option* option) : option_(option) {}
    Argument required() const;
    Argument positive() const;
    Argument not_negative() const;
    Argument between(int lower, int upper) const; // whole numbers, inclusive
    Argument one_of(const std::vector<std::string>& words) const;
    Argument count(int values) const;
    Argument needs(const Argument& other) const;

  private:
    CLI::Option* option_;
};

// A handle: copies speak of the same verb. Every value must outlive the parsing.
class Verb {
  public:
    Verb(CLI::App& app, const std::string& name, const std::string& meaning);
    // A verb of a verb: exactly one of them must be said, and options of the outer one may follow.
    Verb(const Verb& outer, const std::string& name, const std::string& meaning);

    Argument add_flag(const std::string& name, bool& value, const std::string& meaning) const;
    // "name" is an argument by its place, "--name" an option. Of the types listed in verb.cpp.
    template <class Value>
    Argument add_option(const std::string& name, Value& value, const std::string& meaning) const;
    // Hands what was said to `take` instead.
    Argument add_option_function(const std::string& name,
                                 const std::function<void(const std::string&)>& take,
                                 const std::string& meaning) const;
    // At the end of --help.
    void examples(const std::string& lines) const;
    // What the verb does once everything is parsed; throws servoid::Error where it cannot.
    void callback(const std::function<void()>& work) const;

  private:
    CLI::App* verb_;
};

} // namespace servoid::cli
