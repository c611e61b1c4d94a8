// Words, strings and signs of a DBC file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace servoid::can {

enum class TokenKind {
    word,   // a name, a keyword or a number: letters, digits, `_ . + -` and every byte from 0x80 on
    string, // what stands between the quotes, \" as it stands; lines may break within
    sign,   // any other character
    end     // behind the last one
};

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;  // of the text that was split
    long line = 0;          // where it begins
    bool at_margin = false; // nothing, not even a blank, stands before it in its line
};

// That begins a section, or says what a section is about. VERSION and FILTER are not among them:
// signals have these names.
bool is_keyword(const Token& token);
bool is_sign(const Token& token, std::string_view sign);

// Ends with one token of kind `end`. `//` comments are passed over. FileError: a string that is not
// closed (with the line of its first quote).
std::vector<Token> dbc_tokens(std::string_view text, const std::string& path);

} // namespace servoid::can
