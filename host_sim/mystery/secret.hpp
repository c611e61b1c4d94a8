// What is hidden, as one line that nobody reads by accident: a TOML table in base64 (RFC 4648).
#pragma once

#include "mystery/mystery.hpp"

#include <string>

namespace servoid {

// The metadata of a capture with a mystery.
constexpr const char* kMysteryKey = "mystery";       // the seed
constexpr const char* kSecretKey = "mystery_secret"; // the line

std::string encode_secret(const Mystery& mystery);
// Throws FileError with this file and line where the text is no secret.
Mystery decode_secret(const std::string& text, const std::string& file, long line);

std::string base64(const std::string& bytes);
// Empty where the text is not base64.
std::string from_base64(const std::string& text);

// The secret of a capture file (CSV). Throws FileError: not readable, no mystery in it, a secret
// that does not decode.
Mystery read_mystery(const std::string& path);

} // namespace servoid
