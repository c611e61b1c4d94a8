// The language of custom laws: what it means, what it refuses, which parameters are linear.
#include "effects/law.hpp"
#include "effects/law_parts.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <random>
#include <thread>

using namespace servoid;

namespace {

using Names = std::vector<std::string>;

double value(const std::string& law, const AxisPoint& at = {},
             const std::map<std::string, double>& parameters = {}) {
    return Law(law, parameters).at(at);
}

std::string fault(const std::string& law, const Names& parameters = {}) {
    const auto found = find_fault(law, parameters);
    return found ? found->parameter + "|" + found->reason : "";
}

TEST(Law, VariablesAreThePointOfTheAxis) {
    const AxisPoint at{1, 2, 3, 5, 7};
    EXPECT_EQ(value("t", at), 1);
    EXPECT_EQ(value("theta", at), 2);
    EXPECT_EQ(value("v", at), 3);
    EXPECT_EQ(value("T", at), 5);
    EXPECT_EQ(value("a", at), 7);
    EXPECT_EQ(value("k*theta^3 + e_1", at, {{"k", 0.5}, {"e_1", -1}}), 3);
}

TEST(Law, PrecedenceIsThatOfMathematics) {
    const AxisPoint at{0, 0, 3};
    EXPECT_EQ(value("-v^2", at), -9);
    EXPECT_EQ(value("2^3^2"), 512);
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value("v-1-1", at), 1);
    EXPECT_EQ(value("v/2/3", at), 0.5);
    EXPECT_EQ(value("2*-v", at), -6);
    EXPECT_EQ(value("-v*v", at), -9);
    EXPECT_EQ(value("2+v*2^2/4", at), 5);
    EXPECT_EQ(value("1e3*v + .5 + 1.5e-1", at), 3000.65);
    EXPECT_EQ(value("2 *\n v", at), 6);
}

TEST(Law, FunctionsAreThoseOfTheDocumentation) {
    EXPECT_EQ(value("sin(1)"), std::sin(1));
    EXPECT_EQ(value("cos(1)"), std::cos(1));
    EXPECT_EQ(value("tan(1)"), std::tan(1));
    EXPECT_EQ(value("exp(1)"), std::exp(1));
    EXPECT_EQ(value("log(10)"), std::log(10)) << "the natural one";
    EXPECT_EQ(value("sqrt(2)"), std::sqrt(2));
    EXPECT_EQ(value("abs(-2)"), 2);
    EXPECT_EQ(value("tanh(0.3)"), std::tanh(0.3));
    EXPECT_EQ(value("min(2,-3)"), -3);
    EXPECT_EQ(value("max(2,-3)"), 2);
    EXPECT_EQ(value("sign(-0.1)"), -1);
    EXPECT_EQ(value("sign(7)"), 1);
    EXPECT_EQ(value("sign(0)"), 0);
    EXPECT_EQ(law_functions().size(), 11u);
    for (const char* law : {"sqrt(-1)", "max(sqrt(-1),0)", "min(0,sqrt(-1))", "sign(sqrt(-1))"})
        EXPECT_TRUE(std::isnan(value(law))) << law;
}

TEST(Law, ACopyIsAParserOfItsOwn) {
    Law law("k*v", {{"k", 2}});
    Law copy(law);
    copy.set("k", 5);
    EXPECT_EQ(law.at({0, 0, 3}), 6);
    EXPECT_EQ(copy.at({0, 0, 3}), 15);
}

TEST(Law, ThreadsWithLawsOfTheirOwn) {
    const auto work = [](double k, double& sum) {
        Law law("k*tanh(v/vs)", {{"k", k}, {"vs", 2}});
        for (int i = 0; i < 20000; ++i)
            sum += law.at({0, 0, double(i % 7)});
    };
    double one = 0, two = 0, both = 0;
    work(1, one);
    std::thread other([&] { work(2, two); });
    work(1, both);
    other.join();
    EXPECT_EQ(both, one);
    EXPECT_NEAR(two, 2 * one, 1e-9 * two);
}

TEST(Law, ADecimalPointIsAPointInEveryLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"})
        std::setlocale(LC_ALL, name);
    EXPECT_EQ(value("1.5"), 1.5);
    EXPECT_EQ(value("max(1,5)"), 5);
    std::setlocale(LC_ALL, before.c_str());
}

TEST(LawFaults, NothingWrong) {
    EXPECT_EQ(fault("k*theta^3", {"k"}), "");
    EXPECT_EQ(fault("0.1*sin(7*theta)"), "");
    EXPECT_EQ(fault("k * max(abs(v), 1e-3) * sign(v)", {"k"}), "");
}

TEST(LawFaults, EveryOneIsNamed) {
    EXPECT_EQ(fault(""), "|the law is empty; expected an expression such as k*theta^3");
    EXPECT_EQ(fault(" \t"), "|the law is empty; expected an expression such as k*theta^3");
    EXPECT_EQ(fault("k*thet", {"k"}),
              "|the law has an unknown name \"thet\"; did you mean \"theta\"?");
    EXPECT_EQ(fault("k*q", {"k"}),
              "|the law has an unknown name \"q\"; expected t, theta, v, a, T, "
              "k or another declared parameter");
    EXPECT_EQ(fault("sinh(v)").find("|the law has an unknown function \"sinh\""), 0u);
    EXPECT_EQ(fault("k(v)", {"k"}).find("|the law has an unknown function \"k\""), 0u);
    EXPECT_EQ(fault("v", {"v"}), "v|the parameter \"v\" hides the variable of that name; expected "
                                 "another name");
    EXPECT_EQ(fault("sin(v)", {"sin"}),
              "sin|the parameter \"sin\" hides the function of that name; expected another name");
    EXPECT_EQ(fault("k*v", {"k", "c"}), "c|the law does not use the parameter \"c\"; expected it "
                                        "in the law, or not at all");
    EXPECT_EQ(fault("k*v", {"k", "k-1"}), "k-1|\"k-1\" cannot be a parameter of a law; expected a "
                                          "letter, then letters, digits and _");
    EXPECT_EQ(fault("1e3k*v", {"k"}).find("|the law cannot be read"), 0u);
}

// What muParser would let through, and what no law may hold.
TEST(LawFaults, NothingOfTheLibraryIsLetThrough) {
    for (const char* name : {"_pi", "_e", "pi", "e"})
        EXPECT_EQ(fault(std::string("v*") + name).find("|the law has an unknown name"), 0u) << name;
    for (const char* name : {"sum", "avg", "rint", "ln", "log2", "log10", "asin", "sinh"})
        EXPECT_EQ(fault(name + std::string("(v)")).find("|the law has an unknown function"), 0u)
            << name;
    for (const char* law : {"v?1:2", "v=3", "v<2", "v==2", "v&&t", "v||t", "!v", "v!", "\"v\"",
                            "v;t", "v$", "{v}", "v#", "v\\t", "v\x01", "\xc3\xa4"})
        EXPECT_EQ(fault(law).find("|the law has \""), 0u) << law << fault(law);
    for (const char* law : {"v,t",   "v**t",  "v*",    "(v",    "v)",       "()",     "v t",
                            "2v",    "sin v", "sin",   "sin()", "sin(v,t)", "max(v)", "max(v,t,a)",
                            "min()", "1.5.2", "1e999", "--v",   ",",        ".",      "max(,)"})
        EXPECT_EQ(fault(law).find("|the law cannot be read: "), 0u) << law << fault(law);
    EXPECT_NE(fault("max(v)").find("too few parameters for function \"max\""), std::string::npos);
}

TEST(LawFaults, RandomTextIsReadOrRefusedButNeverCrashes) {
    const Names pieces = {"k", "v", "theta", "sin(", "max(", "(", ")", "+",  "-", "*", "/",
                          "^", ",", "1",     "2.5",  "e",    ".", " ", "1e", "T", "a", "abs("};
    int good = 0;
    for (unsigned seed = 1; seed <= 20000; ++seed) {
        std::mt19937_64 random(seed);
        std::string law;
        for (unsigned long n = 1 + random() % 8; n > 0; --n)
            law += pieces[random() % pieces.size()];
        const Names keys = mentions(law, "k") ? Names{"k"} : Names{};
        ASSERT_NO_THROW(good += fault(law, keys).empty()) << law;
    }
    EXPECT_GT(good, 100);
}

LawParts parts(const std::string& law) {
    Names keys;
    for (const LawName& name : names_in(law))
        if (!name.called && name.text != "t" && name.text != "theta" && name.text != "v" &&
            name.text != "a" && name.text != "T")
            keys.push_back(name.text);
    EXPECT_EQ(fault(law, keys), "");
    return parts_of(law, keys);
}

void expect_parts(const std::string& law, const Names& linear, const Names& shapes,
                  bool rest = false) {
    const LawParts p = parts(law);
    EXPECT_EQ(p.linear, linear) << law;
    EXPECT_EQ(p.shapes, shapes) << law;
    EXPECT_EQ(p.rest, rest) << law;
}

TEST(LawParts, LinearParametersAreRecognised) {
    expect_parts("k*theta^3", {"k"}, {});
    expect_parts("-k*v/2", {"k"}, {});
    expect_parts("c+b*v", {"b", "c"}, {});
    expect_parts("b*v+c*v*abs(v)+k*theta+w", {"b", "c", "k", "w"}, {});
    expect_parts("k*tanh(v/vs)", {"k"}, {"vs"});
    expect_parts("k*sqrt(theta)", {"k"}, {});
    expect_parts("k*log(t)*a*T", {"k"}, {});
    expect_parts("(k+c)*v", {"c", "k"}, {});
}

TEST(LawParts, ShapesAreWhatIsNotLinear) {
    expect_parts("k^2*v", {}, {"k"}, true);
    expect_parts("abs(k)*v", {}, {"k"}, true);
    expect_parts("k*sin(n*theta+phi)", {"k"}, {"n", "phi"});
    expect_parts("max(k*v,0)", {}, {"k"}, true);
    expect_parts("k*sign(v-vs)", {"k"}, {"vs"});
    expect_parts("k*exp(-t/tau)*v", {"k"}, {"tau"});
    expect_parts("min(max(k*v,-top),top)", {}, {"k", "top"}, true);
    expect_parts("k*abs(theta)^n", {"k"}, {"n"});
}

// Each alone would do, but not both: the one that takes the law to zero is taken.
TEST(LawParts, JointlyLinear) {
    expect_parts("k*(theta-x)", {"k"}, {"x"});
    expect_parts("s*(theta-b)", {"s"}, {"b"});
    expect_parts("Tc*(1+c*t)*sign(v)", {"Tc"}, {"c"});
}

TEST(LawParts, WhatHasNoParameterIsTheRest) {
    expect_parts("0.1*sin(7*theta)", {}, {}, true);
    expect_parts("v^3+k*v", {"k"}, {}, true);
    expect_parts("sqrt(-1-theta^2)*k", {}, {"k"}, true); // nowhere a value: nothing is known
}

} // namespace
