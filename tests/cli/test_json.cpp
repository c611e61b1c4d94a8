// The JSON that users script against: the schema of every verb and the keys that stay.
#include "cli/run_program.hpp"

#include <cmath>

using namespace servoid::cli_test;

namespace {

const std::string move = "trapezoid:stroke=6.28,velocity=40,acceleration=1500,cycles=4";

void expect_keys(const Json& json, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
        EXPECT_TRUE(json.contains(key)) << key;
}

void expect_parameter(const Json& json, const std::string& unit) {
    expect_keys(json, {"value", "std", "unit"});
    EXPECT_TRUE(json.at("value").is_number());
    EXPECT_TRUE(json.at("std").is_number());
    EXPECT_EQ(json.at("unit"), unit);
}

TEST(Json, Identify) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), "sine", "a.csv");
    const Ended ended = run({"identify", csv, "--frequency", "100", "--json"});
    const Json json = json_of(ended);
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(json.at("schema"), "servoid.identify/1");
    expect_parameter(json.at("inertia"), "kg·m²");
    expect_parameter(json.at("viscous"), "N·m·s/rad");
    expect_keys(json, {"position_amplitude", "torque_amplitude"});
    EXPECT_NEAR(json.at("inertia").at("value").get<double>(), 0.116e-4, 0.015 * 0.116e-4);
    EXPECT_EQ(json.at("frequency_Hz"), 100.0);
    EXPECT_EQ(json.at("window").at("first_period"), 8);
    EXPECT_EQ(json.at("window").at("last_period"), 10);
    EXPECT_EQ(json.at("status"), "ok");
}

TEST(Json, Compare) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), move, "a.csv");
    const Json json = json_of(run({"compare", example("system1.toml"), csv, "--json"}));
    EXPECT_EQ(json.at("schema"), "servoid.compare/1");
    for (const char* key :
         {"torque_error", "noise_floor", "repeatable_share", "samples", "duration_s", "band_Hz"})
        EXPECT_TRUE(json.at(key).is_number()) << key;
    for (const char* key : {"torque_error", "position_error"})
        EXPECT_TRUE(json.at("loop").at(key).is_number()) << key;
    ASSERT_FALSE(json.at("where").empty());
    for (const Json& regime : json.at("where")) {
        EXPECT_TRUE(regime.at("regime").is_string());
        EXPECT_TRUE(regime.at("residual_share").is_number());
        EXPECT_TRUE(regime.at("sample_share").is_number());
    }
    for (const char* group : {"velocity", "position", "acceleration", "torque"}) {
        double samples = 0;
        for (const Json& regime : json.at("where"))
            if (regime.at("group") == group) {
                samples += regime.at("sample_share").get<double>();
                EXPECT_LT(regime.at("from").get<double>(), regime.at("to").get<double>());
                EXPECT_TRUE(regime.at("mean_residual").is_number());
            }
        EXPECT_NEAR(samples, 1, 1e-9) << group;
    }
    for (const char* key : {"base_Hz", "excited", "even", "between"})
        EXPECT_TRUE(json.at("lines").at(key).is_number()) << key;
    EXPECT_TRUE(json.at("lines").contains("odd"));
    EXPECT_TRUE(json.at("lag_s").is_null() || json.at("lag_s").at("unit") == "s");
    EXPECT_TRUE(json.at("band_from").is_string());
}

TEST(Json, CompareHasNoLoopWithoutAController) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), move, "a.csv");
    std::ofstream(folder / "plain.toml")
        << "name = \"plain\"\nmotion = \"rotary\"\n[plant]\ninertia = 0.116e-4\n";
    const Json json =
        json_of(run({"compare", folder / "plain.toml", csv, "--json", "--band", "60"}));
    EXPECT_TRUE(json.at("loop").is_null());
    EXPECT_EQ(json.at("band_Hz"), 60);
}

TEST(Json, Add) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), move, "a.csv");
    const Json json =
        json_of(run({"add", "constant_torque", example("system1.toml"), csv, "--json"}));
    EXPECT_EQ(json.at("schema"), "servoid.add/1");
    EXPECT_EQ(json.at("effect"), "constant_torque");
    EXPECT_LE(json.at("error_after").get<double>(), json.at("error_before").get<double>());
    EXPECT_TRUE(json.at("model").at("effects").contains("constant_torque"));
    EXPECT_EQ(json.at("model").at("motion"), "rotary");
    expect_parameter(json.at("model_parameters").at("inertia"), "kg·m²");
    expect_parameter(json.at("model_parameters").at("coulomb.torque"), "N·m");
}

TEST(Json, Sweep) {
    const Ended ended = run({"sweep", example("system2.toml"), "--json"});
    const Json json = json_of(ended);
    EXPECT_EQ(json.at("schema"), "servoid.sweep/1");
    ASSERT_EQ(json.at("points").size(), 20u);
    for (const Json& point : json.at("points"))
        for (const char* key : {"frequency_Hz", "position_amplitude", "torque_amplitude",
                                "torque_percent_of_rated", "inertia", "error_percent"})
            EXPECT_TRUE(point.at(key).is_number()) << key;
    expect_parameter(json.at("inertia_corrected"), "kg·m²");
}

TEST(Json, Friction) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), "speeds:count=4", "a.csv");
    const Json json = json_of(run({"friction", csv, "--json"}));
    EXPECT_EQ(json.at("schema"), "servoid.friction/1");
    expect_parameter(json.at("viscous"), "N·m·s/rad");
    expect_parameter(json.at("coulomb"), "N·m");
    expect_parameter(json.at("constant_torque"), "N·m");
    EXPECT_EQ(json.at("runs").size(), 8u);
    for (const Json& one : json.at("runs")) {
        EXPECT_EQ(one.at("file"), csv);
        for (const char* key : {"velocity", "torque", "residual"})
            EXPECT_TRUE(one.at(key).is_number()) << key;
    }
    EXPECT_NEAR(json.at("coulomb").at("value").get<double>(), 6.6e-3, 0.01 * 6.6e-3);
    EXPECT_NEAR(json.at("viscous").at("value").get<double>(), 0.75e-4, 0.03 * 0.75e-4);
}

// The same capture, read by an encoder whose zero lies elsewhere.
std::string with_other_zero(const Folder& folder, const std::string& csv, const std::string& name,
                            double zero) {
    std::ifstream in(csv);
    std::ofstream out(folder / name);
    out.precision(12);
    std::string line;
    std::vector<bool> is_position;
    while (std::getline(in, line)) {
        std::stringstream cells(line);
        std::string cell;
        if (line.starts_with("#") || is_position.empty()) {
            out << line << "\n";
            while (!line.starts_with("#") && std::getline(cells, cell, ','))
                is_position.push_back(cell.starts_with("position"));
            continue;
        }
        for (size_t i = 0; std::getline(cells, cell, ','); ++i) {
            out << (i ? "," : "");
            is_position[i] ? out << std::stod(cell) - zero : out << cell;
        }
        out << "\n";
    }
    return folder / name;
}

TEST(Json, PositionZeroOfACaptureThatWasNotHomed) {
    const Folder folder;
    const std::string known = folder / "known.toml", truth = folder / "truth.toml";
    const std::string cogging = "[[effects.cogging]]\namplitude = 0.01\norder = 6.0\nphase = 0.7\n";
    std::ofstream(known) << text_of(example("system1.toml"));
    std::ofstream(truth) << text_of(example("system1.toml")) << cogging;
    const std::string a = simulated(folder, truth, move, "a.csv");
    const std::string b = with_other_zero(folder, a, "b.csv", 0.3);
    const auto expect_zero = [&](const Json& json, const std::string& file) {
        ASSERT_TRUE(json.contains("homing")) << json.at("schema");
        ASSERT_EQ(json.at("homing").size(), 1u);
        const Json& one = json.at("homing").at(0);
        EXPECT_EQ(one.at("capture"), file);
        expect_parameter(one.at("offset"), "rad");
        const double period = 2 * std::acos(-1.0) / 6;
        EXPECT_NEAR(std::remainder(one.at("offset").at("value").get<double>() - 0.3, period), 0,
                    0.01);
    };
    expect_zero(json_of(run({"diagnose", known, a, b, "--json"})), b);
    expect_zero(json_of(run({"refine", known, a, "--validate", b, "--json"})), b);
    expect_zero(json_of(run({"add", "cogging", known, a, b, "--json"})), b);
    expect_zero(json_of(run({"compare", truth, a, b, "--json"})), b);
    EXPECT_NE(run({"diagnose", known, a, b}).out.find("not homed"), std::string::npos);
    EXPECT_FALSE(json_of(run({"compare", truth, a, a, "--json"})).contains("homing"));
    const Json alone = json_of(run({"compare", truth, b, "--json"}));
    EXPECT_FALSE(alone.contains("homing"));
    ASSERT_EQ(alone.at("warnings").size(), 1u);
    EXPECT_NE(alone.at("warnings").at(0).get<std::string>().find("position zero"),
              std::string::npos);
    EXPECT_TRUE(json_of(run({"compare", truth, a, "--json"})).at("warnings").empty());
}

// A spring that stiffens looks like a stop; the law that explains more is in no catalogue.
TEST(Json, LawOfNoCatalogue) {
    const Folder folder;
    const std::string truth = folder / "truth.toml";
    std::ofstream(truth) << text_of(example("system1.toml"))
                         << "[effects.custom.x]\nlaw = \"k*theta^3\"\n"
                            "[effects.custom.x.parameters]\nk = 1e-4\n";
    const std::string csv =
        simulated(folder, truth, "trapezoid:stroke=6.283185307,torque_noise=1e-3", "a.csv");
    const Json found = json_of(run({"diagnose", example("system1.toml"), csv, "--json"}));
    EXPECT_EQ(found.at("verdict"), "unknown");
    ASSERT_TRUE(found.at("outside").is_string());
    EXPECT_NE(found.at("outside").get<std::string>().find("k0+k1*((theta-("), std::string::npos);
    EXPECT_NE(found.at("outside").get<std::string>().find("^3"), std::string::npos);
    EXPECT_EQ(found.at("outside").get<std::string>().find("^1"), std::string::npos);
    const Json climbed = json_of(run({"refine", example("system1.toml"), csv, "--json"}));
    EXPECT_EQ(climbed.at("ladder").size(), 1u) << "a stop was added that is not there";
    EXPECT_TRUE(climbed.at("outside").is_string());
    const Json complete = json_of(run({"diagnose", truth, csv, "--json"}));
    EXPECT_TRUE(complete.at("outside").is_null());
    EXPECT_TRUE(json_of(run({"refine", truth, csv, "--json"})).at("outside").is_null());
}

TEST(Json, SimulateAndEffects) {
    const Folder folder;
    const Json done = json_of(run({"simulate", example("system1.toml"), "--experiment", "sine",
                                   "--seed", "7", "--out", folder / "a.csv", "--json"}));
    EXPECT_EQ(done.at("schema"), "servoid.simulate/1");
    EXPECT_EQ(done.at("samples"), 800);
    EXPECT_EQ(done.at("seed"), 7);
    const Json all = json_of(run({"effects", "--json"}));
    EXPECT_EQ(all.at("schema"), "servoid.effects/1");
    EXPECT_GE(all.at("effects").size(), 5u);
    for (const Json& effect : all.at("effects"))
        expect_keys(effect, {"name", "law", "signature", "reference", "parameters"});
    const Json one = json_of(run({"effects", "coulomb", "--json"}));
    EXPECT_EQ(one.at("name"), "coulomb");
    EXPECT_EQ(one.at("parameters").at(0).at("unit_rotary"), "N·m");
    EXPECT_EQ(one.at("parameters").at(0).at("unit_linear"), "N");
}

} // namespace
