#include "story/provenance.hpp"

#include "common/file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include <array>
#include <cstdlib>
#include <ctime>

namespace servoid {

SourceFile source_of(const std::string& name, const std::string& content) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    EVP_Digest(content.data(), content.size(), digest.data(), &length, EVP_sha256(), nullptr);
    SourceFile out{name, {}, content.size()};
    for (unsigned i = 0; i < length; ++i)
        out.sha256 += fmt::format("{:02x}", digest[i]);
    return out;
}

SourceFile source_file(const std::string& path) { return source_of(path, read_file(path)); }

Json provenance_json(const Provenance& provenance) {
    const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t now =
        epoch && *epoch ? std::time_t(std::strtoll(epoch, nullptr, 10)) : std::time(nullptr);
    Json files = Json::array();
    for (const SourceFile& f : provenance.files)
        files.push_back({{"file", f.file}, {"sha256", f.sha256}, {"bytes", f.bytes}});
    return {{"program", "servoid"},
            {"version", SERVOID_VERSION},
            {"date", fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(now))},
            {"commands", provenance.commands},
            {"files", files}};
}

} // namespace servoid
