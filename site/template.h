// Templates that the build has put into the program, filled with data.
#pragma once

#include <mustache.hpp>
#include <string>
#include <string_view>

namespace shadowbench::site {

using Data = kainjow::mustache::data;

/// Text of an embedded file: "templates/scene.html", "viewer/pane.js". Throws InternalError when there is none of that name.
std::string_view embeddedFile(std::string_view path);

/// The template `name` of templates/ ("scene.html") with `data`: {{key}} escapes for HTML, {{{key}}} is HTML already.
std::string render(std::string_view name, const Data& data);

} // namespace shadowbench::site
