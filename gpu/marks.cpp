#include "gpu/marks.h"

#include "base/error.h"
#include "gpu/spirv.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace shadowbench::gpu {
namespace {

/// How a lane may leave a statement other than at its end.
struct Ways {
    bool function = false; // return, discard
    bool breaks = false, continues = false;

    void operator|=(Ways other) {
        function |= other.function;
        breaks |= other.breaks;
        continues |= other.continues;
    }
    [[nodiscard]] bool any() const { return function || breaks || continues; }
};

/// A word, a number or one character of others, with the space before it.
struct Token {
    std::string space, text;
};

std::vector<Token> tokensOf(const std::string& text) {
    const auto isSpace = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    std::vector<Token> tokens;
    for (std::size_t at = 0; at < text.size();) {
        Token token;
        for (; at < text.size() && isSpace(text[at]); ++at) token.space += text[at];
        for (; at < text.size() && isWord(text[at]); ++at) token.text += text[at];
        if (token.text.empty() && at < text.size()) token.text = text[at++];
        if (!token.text.empty()) tokens.push_back(std::move(token));
    }
    return tokens;
}

/// Copies tokens from its input to its output, with marks between them. It knows where statements begin and end, and of
/// what is within them nothing.
class Marker {
public:
    explicit Marker(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

    Marked all() {
        while (!atEnd())
            if (is("(")) {
                const std::string before = last_;
                copyBracket();
                if (is("{")) function(before);
            } else {
                copy();
            }
        return std::move(marked_);
    }

private:
    [[nodiscard]] bool atEnd() const { return next_ == tokens_.size(); }
    [[nodiscard]] bool is(std::string_view token) const { return !atEnd() && tokens_[next_].text == token; }

    void put(const std::string& text) { marked_.body += text; }

    void copy() {
        if (atEnd()) throw BadInput("marking a shader failed: it ends within a statement; does it compile?");
        if (beforeLast_ == "const") constants_.insert(tokens_[next_].text); // "const int run"
        beforeLast_ = std::exchange(last_, tokens_[next_].text);
        put(tokens_[next_++].space + (last_ == "main" ? "sbMain" : last_));
    }

    void putMark() {
        put(fmt::format(" {}({});", constantLoops_ > 0 ? "SB_INNER" : "SB_MARK", marked_.marks++));
        marked_.hasInner |= constantLoops_ > 0;
    }

    /// Of the head of a loop that comes next, `for (int i = 0; i < COUNT; ++i)`: whether numbers, constants and variables of
    /// loops around it alone are in its test. Remembers its variable.
    bool hasConstantLength() {
        std::size_t at = next_;
        const auto upTo = [&](std::string_view end) {
            std::vector<std::string> words;
            for (; at < tokens_.size() && tokens_[at].text != end; ++at)
                if (std::isalpha(static_cast<unsigned char>(tokens_[at].text[0])) != 0) words.push_back(tokens_[at].text);
            ++at;
            return words;
        };
        (void)upTo("(");
        const std::vector<std::string> first = upTo(";"), test = upTo(";");
        if (first.size() < 2) return false;
        const std::string& variable = first[1]; // "int i = 0"
        const bool isConstant = std::ranges::all_of(
            test, [&](const std::string& word) { return word == variable || constants_.contains(word); });
        if (isConstant) constants_.insert(variable);
        return isConstant;
    }

    /// Up to what closes the bracket that comes next.
    void copyBracket() {
        int depth = 0;
        do {
            if (is("(") || is("{") || is("[")) ++depth;
            if (is(")") || is("}") || is("]")) --depth;
            copy();
        } while (depth > 0);
    }

    void function(const std::string& named) {
        copy();
        if (named == "main") put(" SB_MARK(0);");
        statements();
        copy();
    }

    /// Up to the brace that closes them, which is left. A switch has labels among them.
    Ways statements() {
        Ways all;
        bool left = false; // some lane may have
        while (!is("}")) {
            if (is("case") || is("default")) {
                while (!is(":")) copy();
                copy();
                putMark();
                left = false;
                continue;
            }
            if (left) putMark();
            const Ways ways = statement();
            left = ways.any();
            all |= ways;
        }
        return all;
    }

    Ways statement() {
        if (is("{")) {
            copy();
            const Ways ways = statements();
            copy();
            return ways;
        }
        if (is("if")) return condition();
        if (is("for") || is("while")) return loop();
        if (is("do")) return loopWithTestAtEnd();
        if (is("switch")) return choice();
        return simple();
    }

    Ways simple() {
        Ways ways;
        ways.function = is("return") || is("discard");
        ways.breaks = is("break");
        ways.continues = is("continue");
        const bool leaves = is("discard");
        if (leaves) {
            put(" { SB_LEAVE ");
            marked_.discards = true;
        }
        while (!is(";"))
            if (is("(") || is("{") || is("["))
                copyBracket();
            else
                copy();
        copy();
        if (leaves) put(" }");
        return ways;
    }

    /// A statement that some lanes take and others do not.
    Ways branch() {
        put(" {");
        putMark();
        const Ways ways = statement();
        put(" }");
        return ways;
    }

    Ways condition() {
        copy();
        copyBracket();
        Ways ways = branch();
        if (!is("else")) return ways;
        copy();
        ways |= branch();
        return ways;
    }

    /// What breaks or continues a loop goes on behind it.
    Ways loop() {
        const bool isConstant = is("for") && hasConstantLength();
        copy();
        copyBracket();
        constantLoops_ += isConstant ? 1 : 0;
        const Ways ways = branch();
        constantLoops_ -= isConstant ? 1 : 0;
        return {ways.function, false, false};
    }

    Ways loopWithTestAtEnd() {
        copy();
        const Ways ways = branch();
        while (!is(";")) copy();
        copy();
        return {ways.function, false, false};
    }

    Ways choice() {
        copy();
        copyBracket();
        copy();
        const Ways ways = statements();
        copy();
        return {ways.function, false, ways.continues}; // what breaks it goes on behind it
    }

    std::vector<Token> tokens_;
    std::size_t next_ = 0;
    std::string last_, beforeLast_;
    int constantLoops_ = 0;           // around what comes next
    std::set<std::string> constants_; // names
    Marked marked_;
};

/// The line that a preprocessor's directive is, and what comes behind them all.
Marked split(const std::string& text) {
    Marked parts;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool isDirective =
            line.find_first_not_of(" \t") != std::string::npos && line[line.find_first_not_of(" \t")] == '#';
        (isDirective ? parts.head : parts.body) += line + "\n";
    }
    return parts;
}

bool has(const Marked& marked, std::string_view word) { return marked.body.find(word) != std::string::npos; }

/// A shader that writes memory is run before the test of depth only where it says so. What neither discards nor has an
/// effect of its own may be: as before the marks.
bool mayBeTestedEarly(const Marked& marked) {
    return !marked.discards && !has(marked, "gl_FragDepth") && !has(marked, "buffer") && !has(marked, "image");
}

constexpr std::string_view fragmentPlace = "uint(gl_FragCoord.y) * sbHeader[0] + uint(gl_FragCoord.x)";
constexpr std::string_view invocationPlace =
    "((gl_WorkGroupID.z * gl_NumWorkGroups.y + gl_WorkGroupID.y) * gl_NumWorkGroups.x + gl_WorkGroupID.x) * "
    "gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z + gl_LocalInvocationIndex";

} // namespace

Marked marked(const Shader& shader) {
    Marked parts = split(preprocessed(shader));
    Marked result = Marker(tokensOf(parts.body)).all();
    result.head = std::move(parts.head);
    return result;
}

std::string countingText(const Marked& marked, Stage stage, unsigned binding) {
    std::string zeros, sums;
    for (unsigned k = 0; k < marked.marks; ++k) {
        zeros += k == 0 ? "0u" : ", 0u";
        sums += fmt::format("    sbCounts[place + {0}u] += sbMarks[{0}];\n", k);
    }
    const bool isFragment = stage == Stage::Fragment;
    return fmt::format("{}{}layout(std430, binding = {}) buffer SbCounts {{ uint sbHeader[4]; uint sbCounts[]; }};\n"
                       "uint sbMarks[{}] = uint[]({});\n"
                       "void sbLeave();\n#define SB_MARK(k) ++sbMarks[k]\n#define SB_INNER SB_MARK\n#define SB_LEAVE "
                       "sbLeave();\n{}\n",
                       marked.head, isFragment && mayBeTestedEarly(marked) ? "layout(early_fragment_tests) in;\n" : "",
                       binding, marked.marks, zeros, marked.body) +
           fmt::format("void sbLeave() {{\n    uint place = {};\n"
                       "    uint band = place / sbHeader[1];\n    if (band % sbHeader[2] != 0u) return;\n"
                       "    place = (band / sbHeader[2] * sbHeader[1] + place % sbHeader[1]) * {}u;\n{}}}\nvoid main() {{\n "
                       "   sbMain();\n    sbLeave();\n}}\n",
                       isFragment ? fragmentPlace : invocationPlace, marked.marks, sums);
}

std::string placingText(const Marked& marked, bool inner) {
    return fmt::format("{}layout(std430) volatile buffer SbPlaces {{ uint sbPlaces[]; }};\n"
                       "#define SB_MARK(k) sbPlaces[k] = {}u + uint(k)\n#define SB_INNER(k) {}\n#define SB_LEAVE\n"
                       "{}\nvoid main() {{ sbMain(); }}\n",
                       marked.head, firstPlace, inner ? "SB_MARK(k)" : "", marked.body);
}

} // namespace shadowbench::gpu
