// A torque law as a user writes it: an expression in t theta v a T and parameters of its own.
//
// + - * / ^ bind as in Fortran: −x^2 is −(x^2), 2^3^2 is 2^(3^2). log is the natural logarithm,
// sign(0) is 0, min and max take two arguments, trigonometry is in rad. muParser reads it; nothing
// of its own names, constants and operators is let through.
#pragma once

#include "plant/axis.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mu {
class Parser;
}

namespace servoid {

// A name that stands in a law.
struct LawName {
    std::string text;
    bool called = false; // a parenthesis follows: meant as a function
};

// In the order in which they first appear; numbers such as 1e3 hold none.
std::vector<LawName> names_in(const std::string& law);
bool mentions(const std::string& law, const std::string& name);

const std::vector<std::string>& law_variables(); // t theta v a T
const std::vector<std::string>& law_functions();

// What is wrong with a law and its parameters, and what was expected.
struct LawFault {
    std::string parameter; // the parameter that is wrong; empty: the law
    std::string reason;
};
std::optional<LawFault> find_fault(const std::string& law,
                                   const std::vector<std::string>& parameters);

// What is wrong with the <name> of custom.<name>, or "": it must stand in a TOML key and in front
// of a dot.
std::string fault_of_name(const std::string& name);

// A law ready to be evaluated. A copy is a parser of its own: none is for two threads at once.
class Law {
  public:
    // Throws std::invalid_argument where find_fault() finds one in the expression.
    Law(const std::string& text, const std::map<std::string, double>& parameters);
    Law(const Law& other);
    Law(Law&& other) = delete; // the parser points at the members
    Law& operator=(const Law&) = delete;
    ~Law();

    // Not checked for finite results. Cost: some 5 ns an operation, and the functions.
    double at(const AxisPoint& point);
    void set(const std::string& parameter, double value) { parameters_.at(parameter) = value; }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    std::map<std::string, double> parameters_;
    AxisPoint point_;
    std::unique_ptr<mu::Parser> parser_;
};

} // namespace servoid
