// Captures that are wrong or cannot answer: what each verb says of them, and exit code 4.
#include "cli/run_program.hpp"

#include <functional>

using namespace servoid::cli_test;

namespace {

const std::string move = "trapezoid:stroke=6.28,velocity=40,cycles=4,torque_noise=1e-3";

// The capture with its torque column (the third) changed.
std::string with_torque(const Folder& folder, const std::string& csv,
                        const std::function<double(double)>& change) {
    std::istringstream in(text_of(csv));
    std::ofstream out(folder / "changed.csv");
    std::string line;
    while (std::getline(in, line)) {
        if (line.empty() || !std::isdigit(line[0])) {
            out << line << '\n';
            continue;
        }
        const size_t from = line.find(',', line.find(',') + 1) + 1, to = line.find(',', from);
        std::ostringstream value;
        value.precision(17);
        value << change(std::stod(line.substr(from, to - from)));
        out << line.substr(0, from) << value.str() << line.substr(to) << '\n';
    }
    return folder / "changed.csv";
}

std::string reversed(const Folder& folder) {
    return with_torque(folder, simulated(folder, example("system1.toml"), move, "good.csv"),
                       [](double t) { return -t; });
}

Json refused_json(const Ended& ended) {
    EXPECT_EQ(ended.code, 4) << ended.err;
    const Json json = Json::parse(ended.out, nullptr, false);
    EXPECT_TRUE(json.is_object()) << ended.out;
    return json.is_object() ? json : Json::object();
}

// What `diagnose` says of a capture that cannot answer.
struct Insufficient {
    explicit Insufficient(const std::string& csv)
        : ended(run({"diagnose", example("system1.toml"), csv, "--json"})),
          json(refused_json(ended)) {
        EXPECT_EQ(json.at("verdict"), "insufficient");
    }
    Ended ended;
    Json json;
};

} // namespace

TEST(WrongCapture, EveryVerbThatFitsRefusesAReversedTorque) {
    const Folder folder;
    const std::string csv = reversed(folder), model = example("system1.toml");
    for (const auto& command : std::vector<std::vector<std::string>>{
             {"compare", model, csv},
             {"diagnose", model, csv},
             {"refine", model, csv, "--out", folder / "refined.toml"},
             {"add", "constant_torque", model, csv, "--out", folder / "larger.toml"}}) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.code, 4) << command[0];
        EXPECT_NE(ended.err.find("torque looks reversed"), std::string::npos) << ended.err;
        EXPECT_NE(ended.err.find("; record instead: "), std::string::npos) << ended.err;
        EXPECT_EQ(ended.out, "") << command[0];
    }
    EXPECT_EQ(folder.files().size(), 2u) << "a model was written all the same";
}

TEST(WrongCapture, AUnitIsNamed) {
    const Folder folder;
    const std::string good = simulated(folder, example("system1.toml"), move, "good.csv");
    const std::string csv = with_torque(folder, good, [](double t) { return 1000 * t; });
    const Ended ended = run({"diagnose", example("system1.toml"), csv});
    EXPECT_EQ(ended.code, 4);
    EXPECT_NE(ended.err.find("torque in mN·m"), std::string::npos) << ended.err;
}

TEST(WrongCapture, AColumnOfZerosIsNoTorque) {
    const Folder folder;
    const std::string good = simulated(folder, example("system1.toml"), move, "good.csv");
    const std::string csv = with_torque(folder, good, [](double) { return 0.0; });
    for (const char* verb : {"compare", "diagnose"}) {
        const Ended ended = run({verb, example("system1.toml"), csv});
        EXPECT_EQ(ended.code, 4) << verb;
        EXPECT_NE(ended.err.find("zero throughout"), std::string::npos) << ended.err;
    }
}

TEST(WrongCapture, AGainIsAWarningOnStderrAndInTheJson) {
    const Folder folder;
    const std::string model = example("system1.toml");
    const std::string good = simulated(folder, model, move, "good.csv");
    const std::string csv = with_torque(folder, good, [](double t) { return 1.3 * t; });
    for (const auto& command :
         std::vector<std::vector<std::string>>{{"compare", model, csv, "--json"},
                                               {"diagnose", model, csv, "--json"},
                                               {"add", "constant_torque", model, csv, "--json"}}) {
        const Ended ended = run(command);
        const Json json = json_of(ended);
        ASSERT_EQ(json.at("warnings").size(), 1u) << command[0];
        EXPECT_NE(json.at("warnings")[0].get<std::string>().find("1.3 times"), std::string::npos);
        EXPECT_TRUE(ended.err.starts_with("servoid: warning: ")) << ended.err;
    }
    const Ended quiet = run({"compare", model, good, "--json"});
    EXPECT_EQ(json_of(quiet).at("warnings").size(), 0u);
    EXPECT_EQ(quiet.err, "");
}

// Nothing could be said: the answer is one all the same, with the keys that stay.
TEST(Insufficient, ARefusalIsAnAnswerInJson) {
    const Folder folder;
    const std::string csv = reversed(folder);
    const auto [ended, json] = Insufficient(csv);
    EXPECT_EQ(json.at("schema"), "servoid.diagnose/1");
    EXPECT_NE(json.at("reason").get<std::string>().find("reversed"), std::string::npos);
    EXPECT_TRUE(json.at("advice").get<std::string>().starts_with("record instead: "));
    EXPECT_EQ(json.at("candidates").size(), 0u);
    for (const char* key :
         {"error_before", "noise_floor", "band_Hz", "model_parameters", "next_experiment"})
        EXPECT_TRUE(json.at(key).is_null()) << key;
    EXPECT_TRUE(ended.err.starts_with("servoid: ")) << ended.err;
    const Json refined = refused_json(run({"refine", example("system1.toml"), csv, "--json"}));
    EXPECT_EQ(refined.at("schema"), "servoid.refine/1");
    EXPECT_EQ(refined.at("verdict"), "insufficient");
    EXPECT_EQ(refined.at("ladder").size(), 0u);
    EXPECT_TRUE(refined.at("model").is_null());
}

// Rows of one cruise, without its start: a diagnosis was made, and it says that it is none.
std::string one_speed(const Folder& folder) {
    const std::string all = simulated(folder, example("system1.toml"),
                                      "trapezoid:stroke=20,velocity=30,cycles=1,torque_noise=1e-3",
                                      "there_and_back.csv");
    std::istringstream in(text_of(all));
    std::ofstream out(folder / "cruise.csv");
    std::string line;
    while (std::getline(in, line)) {
        const bool row = !line.empty() && std::isdigit(line[0]);
        const double time = row ? std::stod(line) : 0;
        if (line.starts_with("# period")) continue;
        if (!row || (time > 0.05 && time < 0.6)) out << line << '\n';
    }
    return folder / "cruise.csv";
}

TEST(Insufficient, OneConstantSpeed) {
    const Folder folder;
    const std::string csv = one_speed(folder);
    const auto [ended, json] = Insufficient(csv);
    EXPECT_TRUE(json.at("error_before").is_number());
    EXPECT_FALSE(json.at("candidates").empty());
    ASSERT_FALSE(json.at("cannot_show").empty());
    for (const Json& unseen : json.at("cannot_show"))
        for (const char* key : {"effect", "why", "record"})
            EXPECT_FALSE(unseen.at(key).get<std::string>().empty()) << key;
    EXPECT_NE(ended.err.find("one constant speed"), std::string::npos) << ended.err;
    const Ended text = run({"diagnose", example("system1.toml"), csv});
    EXPECT_EQ(text.code, 4);
    EXPECT_TRUE(text.out.starts_with("insufficient")) << text.out;
    EXPECT_NE(text.out.find("this capture cannot show:"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("coulomb_asymmetric"), std::string::npos) << text.out;
    EXPECT_EQ(run({"refine", example("system1.toml"), csv}).code, 4);
}
