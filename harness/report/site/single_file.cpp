// A site as one file: each page becomes a part of it, and what pages need is put into it.
#include "base/error.h"
#include "base/files.h"
#include "harness/report/site/site.h"
#include "harness/report/site/template.h"
#include "harness/report/slug.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

std::string base64(std::string_view bytes) {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U; };
        const unsigned word = at(0) << 16U | at(1) << 8U | at(2);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63U];
    }
    return text;
}

std::string mediaType(const std::string& extension) {
    static const std::map<std::string, std::string> types{
        {".svg", "image/svg+xml"}, {".png", "image/png"}, {".pdf", "application/pdf"}, {".csv", "text/csv"}};
    const auto found = types.find(extension);
    return found == types.end() ? "text/plain" : found->second;
}

/// What lies between two marks, both left out; "" where they are not there.
std::string between(const std::string& text, std::string_view open, std::string_view close) {
    const std::size_t start = text.find(open);
    if (start == std::string::npos) return "";
    const std::size_t end = text.find(close, start + open.size());
    return end == std::string::npos ? "" : text.substr(start + open.size(), end - start - open.size());
}

/// Values of an attribute of all elements that begin with `element`, in order.
std::vector<std::string> valuesOf(const std::string& html, const std::string& element, const std::string& attribute) {
    std::vector<std::string> values;
    for (std::size_t at = html.find(element); at != std::string::npos; at = html.find(element, at + 1)) {
        const std::string inside = html.substr(at, html.find('>', at) - at);
        if (const std::string value = between(inside, attribute + "=\"", "\""); !value.empty()) values.push_back(value);
    }
    return values;
}

class Folder {
public:
    explicit Folder(fs::path folder) : folder_(std::move(folder)) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_))
            if (entry.path().extension() == ".html")
                pages_.insert(entry.path().lexically_relative(folder_).generic_string());
    }

    /// index.html last: it shows where nothing else is asked for.
    [[nodiscard]] std::vector<std::string> pages() const {
        std::vector<std::string> all(pages_.begin(), pages_.end());
        std::ranges::stable_partition(all, [](const std::string& page) { return page != "index.html"; });
        return all;
    }

    [[nodiscard]] std::string text(const std::string& page) const { return readFile(folder_ / page); }

    static std::string idOf(const std::string& page) { return fmt::format("page-{}", report::slug(page)); }

    /// An address on a page as it is in the one file: a part of it, data, or itself.
    [[nodiscard]] std::string resolved(const std::string& page, const std::string& address) const {
        if (address.empty() || address.starts_with('#') || address.find(':') != std::string::npos) return address;
        const std::string path = pathOf(page, address.substr(0, address.find('#')));
        if (pages_.contains(path)) return fmt::format("#{}", partOf(path, address));
        std::error_code ignored;
        if (!fs::is_regular_file(folder_ / path, ignored)) return address;
        return fmt::format("data:{};base64,{}", mediaType(fs::path(path).extension().string()),
                           base64(readFile(folder_ / path)));
    }

    /// Texts of the files in assets/ that pages name in `element`'s attribute, each once. The cells' viewer is left out: it
    /// shows one scene a page; its pictures stay.
    [[nodiscard]] std::string joined(const std::string& element, const std::string& attribute) const {
        std::vector<std::string> files;
        for (const std::string& page : pages_)
            for (const std::string& value : valuesOf(between(text(page), "<head>", "</head>"), element, attribute))
                if (const std::string path = pathOf(page, value);
                    path.starts_with("assets/") && std::ranges::find(files, path) == files.end())
                    files.push_back(path);
        std::string all;
        for (const std::string& file : files) all += readFile(folder_ / file) + "\n";
        return all;
    }

    /// The scripts that hold the pixel values of cells, sorted.
    [[nodiscard]] std::string pixelScripts() const {
        std::set<fs::path> files;
        std::error_code missing;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "cells", missing))
            if (entry.path().extension() == ".js" && entry.path().filename() != "cells.js") files.insert(entry.path());
        std::string all;
        for (const fs::path& file : files) all += readFile(file);
        return all;
    }

private:
    /// The id that an address on a page leads to: of the page, or of what it names on it.
    [[nodiscard]] std::string partOf(const std::string& page, const std::string& address) const {
        const std::size_t hash = address.find('#');
        const std::string id = hash == std::string::npos ? "" : address.substr(hash + 1);
        const bool exists = !id.empty() && text(page).find(fmt::format(" id=\"{}\"", id)) != std::string::npos;
        return exists ? idOf(page) + "-" + id : idOf(page);
    }

    static std::string pathOf(const std::string& page, const std::string& address) {
        return (fs::path(page).parent_path() / address).lexically_normal().generic_string();
    }

    fs::path folder_;
    std::set<std::string> pages_;
};

/// HTML of a page with its addresses resolved and its ids made its own.
std::string rewritten(const Folder& folder, const std::string& page, const std::string& html) {
    std::string result;
    std::size_t at = 0;
    for (;;) {
        const std::size_t quote = html.find("=\"", at);
        if (quote == std::string::npos) return result + html.substr(at);
        const std::size_t end = html.find('"', quote + 2);
        std::size_t name = quote;
        while (name > at && html[name - 1] != ' ' && html[name - 1] != '\n') --name;
        const std::string attribute = html.substr(name, quote - name), value = html.substr(quote + 2, end - quote - 2);
        result += html.substr(at, quote + 2 - at);
        if (attribute == "href" || attribute == "src")
            result += folder.resolved(page, value);
        else if (attribute == "id" || attribute == "data-table" || attribute == "data-filters")
            result += Folder::idOf(page) + "-" + value;
        else
            result += value;
        result += '"';
        if (attribute == "href" && !folder.resolved(page, value).starts_with('#'))
            result += fmt::format(" download=\"{}\"", value.substr(value.rfind('/') + 1));
        at = end + 1;
    }
}

/// Script text that no "</script>" in it can end.
std::string inlined(const std::string& text, std::string_view end) {
    const std::string start = fmt::format("</{}", end);
    std::string result;
    std::size_t at = 0;
    for (std::size_t next = text.find(start); next != std::string::npos; next = text.find(start, at)) {
        result.append(text, at, next - at).append("<\\/");
        at = next + 2;
    }
    return result.append(text, at, std::string::npos);
}

} // namespace

void writeSingleFile(const fs::path& folder, const fs::path& file) {
    const Folder site(folder);
    Data data, parts{Data::type::list};
    for (const std::string& page : site.pages()) {
        Data part;
        part.set("id", Folder::idOf(page));
        part.set("main", rewritten(site, page, between(site.text(page), "<main id=\"main\">", "</main>")));
        parts << part;
    }
    const std::string index = site.text("index.html");
    data.set("navigation", rewritten(site, "index.html", between(index, "<header class=\"top\">", "</header>")));
    data.set("parts", parts);
    data.set("style", inlined(site.joined("<link rel=\"stylesheet\"", "href"), "style"));
    data.set("script", inlined(site.joined("<script", "src") + site.pixelScripts(), "script"));
    writeFile(file, render("single.html", data));
}

} // namespace shadowbench::site
