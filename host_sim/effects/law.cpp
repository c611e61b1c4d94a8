#include "effects/law.hpp"

#include "common/text.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace servoid {

namespace {

using OneArgument = double (*)(double);
using TwoArguments = double (*)(double, double);

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }

// A number that is none stays none, or a root of a negative number would hide behind a bound.
double bounded(double a, double b, double chosen) {
    return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::quiet_NaN() : chosen;
}

const std::map<std::string, OneArgument>& functions_of_one() {
    static const std::map<std::string, OneArgument> all = {{"sin", [](double x) { return std::sin(x); }},
                                                           {"cos", [](double x) { return std::cos(x); }},
                                                           {"tan", [](double x) { return std::tan(x); }},
                                                           {"exp", [](double x) { return std::exp(x); }},
                                                           {"log", [](double x) { return std::log(x); }},
                                                           {"sqrt", [](double x) { return std::sqrt(x); }},
                                                           {"abs", [](double x) { return std::abs(x); }},
                                                           {"sign", sign},
                                                           {"tanh", [](double x) { return std::tanh(x); }}};
    return all;
}

const std::map<std::string, TwoArguments>& functions_of_two() {
    static const std::map<std::string, TwoArguments> all = {
        {"min", [](double a, double b) { return bounded(a, b, std::min(a, b)); }},
        {"max", [](double a, double b) { return bounded(a, b, std::max(a, b)); }}};
    return all;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_name(char c) { return begins_name(c) || is_digit(c); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool is_name(const std::string& text) {
    return !text.empty() && begins_name(text[0]) &&
           std::all_of(text.begin(), text.end(), continues_name);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Past the number that begins here, its exponent included.
size_t number_end(const std::string& law, size_t i) {
    const auto digits = [&](size_t at) {
        while (at < law.size() && is_digit(law[at]))
            ++at;
        return at;
    };
    i = digits(i);
    if (i < law.size() && law[i] == '.') i = digits(i + 1);
    if (i >= law.size() || (law[i] != 'e' && law[i] != 'E')) return i;
    size_t exponent = i + 1;
    if (exponent < law.size() && (law[exponent] == '+' || law[exponent] == '-')) ++exponent;
    const size_t end = digits(exponent);
    return end > exponent ? end : i;
}

// A parser that knows what a law may hold and nothing else. muParser's own operators beyond
// + - * / ^ are kept out by find_fault(), which does not let their characters through.
std::unique_ptr<mu::Parser> bare_parser() {
    auto parser = std::make_unique<mu::Parser>();
    parser->ClearFun();
    parser->ClearConst();
    parser->ClearOprt();
    parser->ClearPostfixOprt();
    for (const auto& [name, function] : functions_of_one())
        parser->DefineFun(name, function);
    for (const auto& [name, function] : functions_of_two())
        parser->DefineFun(name, function);
    return parser;
}

// Line ends of a text over several lines are spaces.
std::string in_one_line(std::string law) {
    std::replace_if(law.begin(), law.end(), is_space, ' ');
    return law;
}

std::string message_of(const mu::ParserError& error) {
    std::string text = error.GetMsg();
    while (!text.empty() && (text.back() == '.' || text.back() == ' '))
        text.pop_back();
    if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = char(text[0] - 'A' + 'a');
    return text;
}

std::vector<std::string> all_of(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::optional<LawFault> fault_of_parameters(const std::string& law,
                                            const std::vector<std::string>& parameters) {
    for (const std::string& key : parameters) {
        if (!is_name(key))
            return LawFault{key, in_quotes(key) +
                                     " cannot be a parameter of a law; expected a letter, then "
                                     "letters, digits and _"};
        const bool variable = contains(law_variables(), key);
        if (variable || contains(law_functions(), key))
            return LawFault{key, "the parameter " + in_quotes(key) + " hides the " +
                                     (variable ? "variable" : "function") +
                                     " of that name; expected another name"};
        if (!mentions(law, key))
            return LawFault{key, "the law does not use the parameter " + in_quotes(key) +
                                     "; expected it in the law, or not at all"};
    }
    return std::nullopt;
}

// Between names of a letter or two every other is near.
std::string meant_instead(const std::string& name, const std::vector<std::string>& known) {
    const std::string near = name.size() > 2 ? closest_name(name, known) : "";
    if (!near.empty()) return "; did you mean " + in_quotes(near) + "?";
    return "; expected " + join(known) + " or another declared parameter";
}

std::optional<LawFault> fault_of_names(const std::string& law,
                                       const std::vector<std::string>& parameters) {
    for (const LawName& name : names_in(law)) {
        if (contains(law_functions(), name.text)) continue;
        if (name.called)
            return LawFault{"", "the law has an unknown function " + in_quotes(name.text) +
                                    suggestion(name.text, law_functions())};
        const auto known = all_of(law_variables(), parameters);
        if (!contains(known, name.text))
            return LawFault{"", "the law has an unknown name " + in_quotes(name.text) +
                                    meant_instead(name.text, known)};
    }
    return std::nullopt;
}

std::optional<LawFault> fault_of_characters(const std::string& law) {
    if (trim(in_one_line(law)).empty())
        return LawFault{"", "the law is empty; expected an expression such as k*theta^3"};
    for (const char c : law)
        if (!continues_name(c) && !is_space(c) &&
            std::string("+-*/^().,").find(c) == std::string::npos)
            return LawFault{"", "the law has " + in_quotes(std::string(1, c)) +
                                    "; expected names, numbers, parentheses and + - * / ^"};
    return std::nullopt;
}

std::optional<LawFault> fault_of_syntax(const std::string& law,
                                        const std::vector<std::string>& parameters) try {
    std::map<std::string, double> values;
    for (const std::string& key : parameters)
        values[key] = 1;
    const Law compiled(law, values);
    return std::nullopt;
} catch (const std::invalid_argument& error) {
    return LawFault{"", std::string("the law cannot be read: ") + error.what() +
                            "; expected an expression such as k*theta^3"};
}

} // namespace

std::vector<LawName> names_in(const std::string& law) {
    std::vector<LawName> out;
    for (size_t i = 0; i < law.size();) {
        if (is_digit(law[i]) || (law[i] == '.' && i + 1 < law.size() && is_digit(law[i + 1]))) {
            i = number_end(law, i);
            continue;
        }
        size_t end = i;
        while (begins_name(law[i]) && end < law.size() && continues_name(law[end]))
            ++end;
        if (end > i) {
            const size_t next = law.find_first_not_of(" \t\n\r", end);
            const bool called = next != std::string::npos && law[next] == '(';
            const std::string text = law.substr(i, end - i);
            if (std::none_of(out.begin(), out.end(), [&](const LawName& n) {
                    return n.text == text && n.called == called;
                }))
                out.push_back({text, called});
        }
        i = std::max(end, i + 1);
    }
    return out;
}

bool mentions(const std::string& law, const std::string& name) {
    for (const LawName& one : names_in(law))
        if (one.text == name) return true;
    return false;
}

const std::vector<std::string>& law_variables() {
    static const std::vector<std::string> all = {"t", "theta", "v", "a", "T"};
    return all;
}

const std::vector<std::string>& law_functions() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const auto& [name, function] : functions_of_one())
            names.push_back(name);
        for (const auto& [name, function] : functions_of_two())
            names.push_back(name);
        return names;
    }();
    return all;
}

std::string fault_of_name(const std::string& name) {
    const auto fits = [](char c) { return continues_name(c) || c == '-'; };
    if (!name.empty() && std::all_of(name.begin(), name.end(), fits)) return "";
    return "custom." + name +
           " cannot be the name of a law; expected custom. and then letters, "
           "digits, _ or -";
}

std::optional<LawFault> find_fault(const std::string& law,
                                   const std::vector<std::string>& parameters) {
    if (auto fault = fault_of_characters(law)) return fault;
    if (auto fault = fault_of_names(law, parameters)) return fault;
    if (auto fault = fault_of_parameters(law, parameters)) return fault;
    return fault_of_syntax(law, parameters);
}

Law::Law(const std::string& text, const std::map<std::string, double>& parameters) try
    : text_(text), parameters_(parameters), parser_(bare_parser()) {
    parser_->DefineVar("t", &point_.time_s);
    parser_->DefineVar("theta", &point_.position);
    parser_->DefineVar("v", &point_.velocity);
    parser_->DefineVar("a", &point_.acceleration);
    parser_->DefineVar("T", &point_.torque);
    for (auto& [key, value] : parameters_)
        parser_->DefineVar(key, &value);
    parser_->SetExpr(in_one_line(text_));
    parser_->Eval(); // compiles
    if (parser_->GetNumResults() != 1)
        throw std::invalid_argument("a comma outside of min and max");
} catch (const mu::ParserError& error) {
    throw std::invalid_argument(message_of(error));
}

Law::Law(const Law& other) : Law(other.text_, other.parameters_) {}
Law::~Law() = default;

// One row after another: muParser's own evaluation of arrays starts threads for each call and was
// slower.
double Law::at(const AxisPoint& point) {
    point_ = point;
    return parser_->Eval();
}

} // namespace servoid
