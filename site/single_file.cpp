// A site as one file: each page becomes a part of it, and what pages need is put into it.
#include "base/base64.h"
#include "base/files.h"
#include "report/slug.h"
#include "site/made_file.h"
#include "site/site.h"
#include "site/template.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

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

std::string dataAddress(const fs::path& file) {
    return fmt::format("data:{};base64,{}", mediaType(file.extension().string()), base64(readFile(file)));
}

class Folder {
public:
    explicit Folder(fs::path folder) : folder_(std::move(folder)) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_))
            if (entry.path().extension() == ".html")
                pages_.emplace(entry.path().lexically_relative(folder_).generic_string(), readFile(entry.path()));
    }

    /// index.html last: it shows where nothing else is asked for.
    [[nodiscard]] std::vector<std::string> pages() const {
        std::vector<std::string> all;
        for (const auto& [page, html] : pages_) all.push_back(page);
        std::ranges::stable_partition(all, [](const std::string& page) { return page != "index.html"; });
        return all;
    }

    [[nodiscard]] const std::string& text(const std::string& page) const { return pages_.at(page); }

    static std::string idOf(const std::string& page) { return fmt::format("page-{}", report::slug(page)); }

    /// An address on a page as it is in the one file: a part of it, data, or itself.
    [[nodiscard]] std::string resolved(const std::string& page, const std::string& address) const {
        if (address.empty() || address.find(':') < address.find('#')) return address;
        const std::string path = address.starts_with('#') ? page : pathOf(page, address.substr(0, address.find('#')));
        if (pages_.contains(path)) return fmt::format("#{}", partOf(path, address));
        std::error_code ignored;
        if (!fs::is_regular_file(folder_ / path, ignored)) return address;
        return dataAddress(folder_ / path);
    }

    /// Texts of the files in assets/ that pages name in `element`'s attribute, each once.
    [[nodiscard]] std::string joined(const std::string& element, const std::string& attribute) const {
        std::vector<std::string> files;
        for (const auto& [page, html] : pages_)
            for (const std::string& value : valuesOf(between(html, "<head>", "</head>"), element, attribute))
                if (const std::string path = pathOf(page, value);
                    path.starts_with("assets/") && std::ranges::find(files, path) == files.end())
                    files.push_back(path);
        std::string all;
        for (const std::string& file : files) all += readFile(folder_ / file) + "\n";
        return all;
    }

    /// What the viewer of cells reads: its scripts of scenes and pixel values, and the pictures of sequences by their
    /// addresses from cells/.
    [[nodiscard]] std::string cellScripts() const {
        std::set<fs::path> files;
        std::error_code missing;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "cells", missing))
            files.insert(entry.path());
        std::string scripts;
        nlohmann::ordered_json pictures = nlohmann::ordered_json::object();
        for (const fs::path& file : files) {
            const std::string stem = file.stem().string();
            if (file.extension() == ".js") scripts += readFile(file);
            if (file.extension() == ".png" && (stem.ends_with("-sequence") || stem.ends_with("-flicker")))
                pictures[file.lexically_relative(folder_ / "cells").generic_string()] = dataAddress(file);
        }
        return files.empty() ? "" : fmt::format("{}shadowbench.files = {};\n", scripts, pictures.dump());
    }

    static std::string pathOf(const std::string& page, const std::string& address) {
        return (fs::path(page).parent_path() / address).lexically_normal().generic_string();
    }

    [[nodiscard]] std::string dataOf(const std::string& path) const { return dataAddress(folder_ / path); }

private:
    /// The id that an address on a page leads to: of the page, or of what it names on it. The viewer's own addresses are
    /// read behind the id of the cell that they name.
    [[nodiscard]] std::string partOf(const std::string& page, const std::string& address) const {
        const std::size_t hash = address.find('#');
        const std::string name = hash == std::string::npos ? "" : address.substr(hash + 1);
        const std::string id = name.substr(0, name.find('&'));
        for (const std::string& known : {id, "cell-" + id})
            if (!id.empty() && text(page).find(fmt::format(" id=\"{}\"", known)) != std::string::npos)
                return fmt::format("{}-{}{}", idOf(page), known, name.substr(id.size()));
        return idOf(page);
    }

    fs::path folder_;
    std::map<std::string, std::string> pages_; // by address
};

/// Pictures of a stated size that pages show several times, such as the truth of every cell: they are held once.
class SharedPictures {
public:
    explicit SharedPictures(const Folder& folder) : folder_(folder) {
        std::map<std::string, int> times;
        for (const std::string& page : folder.pages())
            for (const std::string& address : valuesOf(folder.text(page), "<img ", " src"))
                if (++times[Folder::pathOf(page, address)] == 2)
                    shared_.emplace(Folder::pathOf(page, address), fmt::format("shared-{}", shared_.size()));
    }

    /// HTML of a page in which these are references.
    std::string referTo(const std::string& page, const std::string& html) {
        std::string result;
        std::size_t at = 0;
        for (std::size_t start = 0; (start = html.find("<img ", at)) != std::string::npos;) {
            const std::size_t end = html.find('>', start) + 1;
            result.append(html, at, start - at).append(reference(page, html.substr(start, end - start)));
            at = end;
        }
        return result.append(html, at, std::string::npos);
    }

    /// What the references refer to, which is not shown itself.
    [[nodiscard]] std::string definitions() const {
        std::string images;
        for (const auto& [path, size] : sizes_)
            images += fmt::format("<image id=\"{}\" {} href=\"{}\"/>\n", shared_.at(path), size, folder_.dataOf(path));
        return images.empty() ? ""
                              : fmt::format("<svg class=\"heard\" aria-hidden=\"true\"><defs>\n{}</defs></svg>\n", images);
    }

private:
    std::string reference(const std::string& page, const std::string& image) {
        const std::string path = Folder::pathOf(page, between(image, " src=\"", "\""));
        const std::string width = between(image, " width=\"", "\""), height = between(image, " height=\"", "\"");
        if (width.empty() || height.empty() || !shared_.contains(path)) return image;
        sizes_[path] = fmt::format("width=\"{}\" height=\"{}\"", width, height);
        return fmt::format("<svg class=\"picture\" role=\"img\" aria-label=\"{}\" viewBox=\"0 0 {} {}\">"
                           "<use xlink:href=\"#{}\"/></svg>",
                           between(image, " alt=\"", "\""), width, height, shared_.at(path));
    }

    const Folder& folder_;
    std::map<std::string, std::string> shared_; // path → id
    std::map<std::string, std::string> sizes_;  // of those that are referred to
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
        const bool leads = attribute == "href" || attribute == "src";
        const std::string address = leads ? folder.resolved(page, value) : "";
        result += html.substr(at, quote + 2 - at);
        if (leads)
            result += address;
        else if (attribute == "id" || attribute == "data-table" || attribute == "data-filters")
            result += Folder::idOf(page) + "-" + value;
        else
            result += value;
        result += '"';
        if (attribute == "href" && !address.starts_with('#'))
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
    const std::string index = site.text("index.html"), header = between(index, "<header class=\"top\">", "</header>");
    SharedPictures shared(site);
    std::string parts;
    for (const std::string& page : site.pages()) {
        const std::string main = between(site.text(page), "<main id=\"main\">", "</main>");
        parts += fmt::format("<div class=\"page\" id=\"{}\">\n{}</div>\n", Folder::idOf(page),
                             rewritten(site, page, shared.referTo(page, main)));
    }
    const std::string style =
        site.joined("<link rel=\"stylesheet\"", "href") + std::string(embeddedFile("assets/single.css"));
    const std::string script = site.joined("<script", "src") + site.cellScripts();
    writeMade(file, fmt::format("{}<style>\n{}</style>\n</head>\n<body>{}<header class=\"top\">{}</header>\n"
                                "{}<main id=\"main\">\n{}</main>\n<script>\n{}</script>\n</body>\n</html>\n",
                                index.substr(0, index.find("<link rel=\"stylesheet\"")), inlined(style, "style"),
                                between(index, "<body>", "<header"), rewritten(site, "index.html", header),
                                shared.definitions(), parts, inlined(script, "script")));
}

} // namespace shadowbench::site
