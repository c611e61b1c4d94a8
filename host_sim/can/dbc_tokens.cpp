#include "can/dbc_tokens.hpp"

#include "common/error.hpp"

#include <algorithm>

namespace servoid::can {

namespace {

constexpr std::string_view keywords =
    " NS_ BS_ BU_ BO_ SG_ EV_ CM_ VAL_ VAL_TABLE_ BA_ BA_DEF_ BA_DEF_DEF_ BA_REL_ "
    "BA_DEF_REL_ BA_DEF_DEF_REL_ BA_SGTYPE_ BA_DEF_SGTYPE_ BO_TX_BU_ ENVVAR_DATA_ EV_DATA_ SGTYPE_ "
    "SGTYPE_VAL_ SIG_TYPE_REF_ SIG_GROUP_ SIG_VALTYPE_ SIGTYPE_VALTYPE_ SG_MUL_VAL_ CAT_ CAT_DEF_ "
    "BU_SG_REL_ BU_EV_REL_ BU_BO_REL_ NS_DESC_ ";

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '+' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
}

class Splitter {
  public:
    Splitter(std::string_view text, const std::string& path) : text_(text), path_(path) {}

    std::vector<Token> split() {
        for (pass_over_blanks(); at_ < text_.size(); pass_over_blanks())
            read_token();
        add(TokenKind::end, {});
        return std::move(tokens_);
    }

  private:
    void pass_over_blanks() {
        while (at_ < text_.size()) {
            if (text_.substr(at_).starts_with("//"))
                at_ = std::min(text_.find('\n', at_), text_.size());
            else if (is_blank(text_[at_]))
                line_ += text_[at_++] == '\n';
            else
                return;
        }
    }

    void add(TokenKind kind, std::string_view text) {
        const bool at_margin = at_ == 0 || text_[at_ - 1] == '\n';
        tokens_.push_back({kind, text, line_, at_margin});
    }

    void read_token() {
        if (text_[at_] == '"') return read_string();
        size_t size = 0;
        while (at_ + size < text_.size() && is_word(text_[at_ + size]))
            ++size;
        const TokenKind kind = size > 0 ? TokenKind::word : TokenKind::sign;
        size = std::max<size_t>(size, 1);
        add(kind, text_.substr(at_, size));
        at_ += size;
    }

    void read_string() {
        const size_t first = at_ + 1;
        size_t end = text_.find('"', first);
        while (end != std::string_view::npos && end > first && text_[end - 1] == '\\')
            end = text_.find('"', end + 1);
        if (end == std::string_view::npos)
            throw FileError(path_, line_, "a string is not closed; expected a second \"");
        const std::string_view inside = text_.substr(first, end - first);
        add(TokenKind::string, inside);
        line_ += std::count(inside.begin(), inside.end(), '\n');
        at_ = end + 1;
    }

    std::string_view text_;
    const std::string& path_;
    size_t at_ = 0;
    long line_ = 1;
    std::vector<Token> tokens_;
};

} // namespace

bool is_keyword(const Token& token) {
    return token.kind == TokenKind::word &&
           keywords.find(' ' + std::string(token.text) + ' ') != std::string_view::npos;
}

bool is_sign(const Token& token, std::string_view sign) {
    return token.kind == TokenKind::sign && token.text == sign;
}

std::vector<Token> dbc_tokens(std::string_view text, const std::string& path) {
    return Splitter(text, path).split();
}

} // namespace servoid::can
