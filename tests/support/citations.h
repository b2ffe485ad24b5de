// What our comments and pages cite, held against the tree: paths, sections of pages, links.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::citations {

/// Files and folders by their paths from the root, and the pages' headings.
struct Tree {
    std::set<std::string> paths;
    std::set<std::string> tails;                              // of every file: its name, with its folder, and so on
    std::map<std::string, std::vector<std::string>> headings; // by page

    void add(const std::string& file) {
        std::filesystem::path path = file;
        for (std::filesystem::path up = path; !up.empty(); up = up.parent_path()) paths.insert(up.string());
        std::string tail;
        for (; !path.empty(); path = path.parent_path()) {
            tail = path.filename().string() + (tail.empty() ? "" : "/" + tail);
            tails.insert(tail);
        }
    }
};

inline bool holds(std::string_view text, char c) { return text.find(c) != std::string_view::npos; }

inline std::vector<std::string> linesOf(std::string_view text) {
    std::vector<std::string> lines(1);
    for (const char c : text)
        if (c == '\n')
            lines.emplace_back();
        else
            lines.back() += c;
    return lines;
}

/// The lines of a page without its blocks of code.
inline std::vector<std::string> proseOf(std::string_view page) {
    std::vector<std::string> prose;
    bool code = false;
    for (std::string& line : linesOf(page)) {
        if (line.starts_with("```"))
            code = !code;
        else if (!code)
            prose.push_back(std::move(line));
    }
    return prose;
}

inline std::vector<std::string> headingsOf(std::string_view page) {
    std::vector<std::string> headings;
    for (const std::string& line : proseOf(page))
        if (const std::size_t level = line.find_first_not_of('#');
            level != 0 && level != std::string::npos && line[level] == ' ')
            headings.push_back(line.substr(level + 1));
    return headings;
}

/// The anchor that hosts such as GitHub give a heading.
inline std::string anchorOf(std::string_view heading) {
    std::string anchor;
    for (const char c : heading) {
        if (c == ' ')
            anchor += '-';
        else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || (c & 0x80) != 0)
            anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return anchor;
}

/// The comments of a source file, each run of lines as one text. `slashes`: of C++ and GLSL; else those that begin with #.
inline std::vector<std::string> commentsOf(std::string_view source, bool slashes) {
    std::vector<std::string> comments;
    bool running = false; // the line before ended in a comment
    for (const std::string& line : linesOf(source)) {
        std::size_t at = std::string::npos, length = slashes ? 2 : 1;
        bool quoted = false;
        for (std::size_t i = 0; i < line.size() && at == std::string::npos; ++i) {
            if (slashes && line[i] == '\\')
                ++i;
            else if (slashes && line[i] == '"')
                quoted = !quoted;
            else if (!quoted && (slashes ? line.compare(i, 2, "//") == 0 || line.compare(i, 2, "/*") == 0
                                         : line[i] == '#' && (i == 0 || line[i - 1] == ' ')))
                at = i;
        }
        if (at == std::string::npos) {
            running = false;
            continue;
        }
        while (at + length < line.size() && (line[at + length] == '/' || line[at + length] == ' ')) ++length;
        const bool alone = line.find_first_not_of(' ') == at;
        if (running && alone)
            comments.back() += " " + line.substr(at + length);
        else
            comments.push_back(line.substr(at + length));
        running = true;
    }
    return comments;
}

/// The page that `named` is, cited by its path from the root or by its name alone; "" if there is none.
inline std::string pageNamed(const Tree& tree, const std::string& named) {
    for (const auto& [page, headings] : tree.headings)
        if (page == named || page == "docs/" + named) return page;
    return "";
}

/// Words that may be paths: runs of their characters, without the full stop of a sentence.
inline std::vector<std::string> pathWords(std::string_view text) {
    const auto inPath = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || holds("_./*-", c); };
    std::vector<std::string> words;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && inPath(text[end])) ++end;
        std::string word(text.substr(i, end - i));
        while (word.ends_with('.') || word.ends_with('-') || word.ends_with('/')) word.pop_back();
        const bool partOfMore = i > 0 && holds("$<>{}~:", text[i - 1]); // a variable, a URL, <id>/…
        const bool goesOn = end < text.size() && holds("<{$", text[end]);
        if (!word.empty() && !partOfMore && !goesOn) words.push_back(std::move(word));
        i = std::max(end, i + 1);
    }
    return words;
}

inline bool matchesPattern(std::string_view pattern, std::string_view path) {
    if (pattern.empty()) return path.empty();
    if (pattern.front() == '*')
        return matchesPattern(pattern.substr(1), path) || (!path.empty() && matchesPattern(pattern, path.substr(1)));
    return !path.empty() && pattern.front() == path.front() && matchesPattern(pattern.substr(1), path.substr(1));
}

/// Whether a word that looks like one of our paths leads nowhere. What commands write into results/ may be there or not.
inline bool isStalePath(const Tree& tree, const std::string& word) {
    static const std::array written{"results/latest", "results/mine",      "results/large",
                                    "results/sweep",  "results/recommend", "results/reproduced"};
    static const std::array endings{".h", ".cpp", ".glsl", ".vert", ".frag", ".comp", ".cmake"};
    const auto isBelow = [&](const char* folder) { return word.starts_with(std::string(folder) + "/"); };
    const auto isIn = [&](const char* folder) { return word == folder || isBelow(folder); };
    if (std::ranges::any_of(written, isIn)) return false;
    if (const std::size_t slash = word.find('/');
        slash != 0 && holds(word, '/') && tree.paths.contains(word.substr(0, slash))) {
        if (holds(word, '*'))
            return std::ranges::none_of(tree.paths, [&](auto& path) { return matchesPattern(word, path); });
        return !tree.paths.contains(word);
    }
    if (word.starts_with("embedded_")) return false; // made by the build
    const bool ofOurs = std::ranges::any_of(endings, [&](const char* ending) { return word.ends_with(ending); });
    return ofOurs && !holds(word, '*') && !word.starts_with('.') && !word.starts_with('_') && !tree.tails.contains(word);
}

/// What a text cites that is not there: paths, from the root or from the text's own folder, and sections of pages, as in
/// `docs/gate.md, "Time"`.
inline std::vector<std::string> staleIn(const Tree& tree, std::string_view text, const std::string& folder = {}) {
    std::vector<std::string> stale;
    for (const std::string& word : pathWords(text))
        if (isStalePath(tree, word) && !tree.paths.contains(folder + "/" + word))
            stale.push_back("no file or folder: " + word);
    for (std::size_t at = text.find(".md"); at != std::string_view::npos; at = text.find(".md", at + 3)) {
        std::size_t begin = at;
        while (begin > 0 && !holds(" (\"'`[", text[begin - 1])) --begin;
        const std::string named(text.substr(begin, at + 3 - begin));
        std::string_view rest = text.substr(at + 3);
        while (rest.starts_with('`') || rest.starts_with(',') || rest.starts_with(':') || rest.starts_with(' '))
            rest.remove_prefix(1);
        const std::string page = pageNamed(tree, named);
        if (!rest.starts_with('"') || holds(named, '*')) continue;
        const std::string section(rest.substr(1, rest.find('"', 1) - 1));
        if (page.empty())
            stale.push_back("no page: " + named);
        else if (std::ranges::find(tree.headings.at(page), section) == tree.headings.at(page).end())
            stale.push_back(fmt::format("no section of {}: {}", page, section));
    }
    return stale;
}

/// Pages that a comment names as it names no file: they are cited by their paths.
inline std::vector<std::string> barePagesIn(std::string_view comment) {
    static const std::array pages{"README", "METRICS", "GATE",  "GROUNDTRUTH", "RECORDS",
                                  "SCENES", "DESIGN",  "STYLE", "CLAIMS"};
    std::vector<std::string> bare;
    for (const std::string_view page : pages) {
        for (std::size_t at = comment.find(page); at != std::string_view::npos; at = comment.find(page, at + 1)) {
            const auto isWord = [](char c) {
                return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
            };
            const std::string_view rest = comment.substr(at + page.size());
            const bool whole = (at == 0 || !isWord(comment[at - 1])) && (rest.empty() || !isWord(rest[0]));
            const bool isFile = page == "README" && rest.starts_with(".md");
            if (whole && !isFile) bare.push_back(fmt::format("cite the page by its path: {}", page));
        }
    }
    return bare;
}

/// Links of the page `file` that lead nowhere: to no file, or to no heading of one. Links to other sites are not followed.
inline std::vector<std::string> deadLinks(const Tree& tree, const std::string& file, std::string_view page) {
    std::vector<std::string> dead;
    for (const std::string& line : proseOf(page)) {
        for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
            const std::size_t begin = at + 2, end = std::min(line.find(')', begin), line.size());
            std::string link = line.substr(begin, end - begin);
            if (link.starts_with('<')) link = link.substr(1, link.find('>') - 1);
            if (holds(link, ':')) continue;
            const std::size_t hash = std::min(link.find('#'), link.size());
            const auto folder = std::filesystem::path(file).parent_path();
            std::string target = hash == 0 ? file : (folder / link.substr(0, hash)).lexically_normal().string();
            if (target.ends_with('/')) target.pop_back();
            if (!tree.paths.contains(target)) {
                dead.push_back("no file or folder behind the link: " + link);
            } else if (hash < link.size()) {
                const auto found = tree.headings.find(target);
                const auto is = [&](const std::string& heading) { return anchorOf(heading) == link.substr(hash + 1); };
                if (found == tree.headings.end() || std::ranges::none_of(found->second, is))
                    dead.push_back("no heading behind the link: " + link);
            }
        }
    }
    return dead;
}

} // namespace shadowbench::citations
