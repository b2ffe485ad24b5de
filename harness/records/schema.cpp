// The JSON Schema of a record: the parts that are no metrics as they stand here, the metrics from their table.
#include "harness/records/fields.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* withoutMetrics = R"({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "title": "shadowbench record",
  "description": "One line of results.jsonl: accuracy, stability and cost of one cell (scene × technique variant × profile). A metric that does not apply is absent. Rates are fractions, times milliseconds, sizes bytes.",
  "type": "object",
  "additionalProperties": false,
  "required": ["schema_version", "scene", "technique", "variant", "parameters", "profile", "size", "frames", "seed", "status",
               "commit", "dirty", "time", "environment"],
  "properties": {
    "schema_version": {"const": 1},
    "scene": {"type": "string"},
    "technique": {"type": "string"},
    "variant": {"type": "string", "description": "canonical: parameters in declared order, defaults left out"},
    "parameters": {"type": "object", "additionalProperties": {"type": ["number", "string"]}},
    "profile": {"enum": ["gate", "standard", "paper"]},
    "size": {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 2, "maxItems": 2},
    "frames": {"$ref": "#/definitions/count"},
    "seed": {"$ref": "#/definitions/count"},
    "status": {"enum": ["scored", "not-applicable", "expected-failure", "error"]},
    "reason": {"type": "string", "minLength": 1},
    "cell": {"type": "string", "description": "hash of the cell's inputs"},
    "commit": {"type": "string"},
    "dirty": {"type": "boolean"},
    "program": {"type": "string", "description": "hash of the program's sources and compiler"},
    "metric_code": {"type": "string", "description": "hash of the sources that score"},
    "images": {"type": "string", "description": "hash of all frames that were scored"},
    "truths": {"type": "string", "description": "hash of the keys and contents of what they were scored against"},
    "time": {"type": "string", "description": "ISO 8601, UTC"},
    "environment": {
      "type": "object",
      "additionalProperties": false,
      "required": ["renderer", "gl", "raster_threads", "vector_bits", "cpu", "compiler"],
      "properties": {
        "renderer": {"type": "string"},
        "gl": {"type": "string"},
        "raster_threads": {"$ref": "#/definitions/count"},
        "vector_bits": {"$ref": "#/definitions/count"},
        "cpu": {"type": "string"},
        "compiler": {"type": "string"},
        "valgrind": {"type": "string"},
        "cpu_features": {"type": "string", "description": "family, model, stepping and a hash of the features"},
        "mesa": {"type": "string", "description": "packages of the rasteriser, with their revisions"},
        "libraries": {"type": "string", "description": "C and C++ library, with their revisions"},
        "platform": {"type": "string", "description": "what gave the program its OpenGL: osmesa (as in older records) or egl"},
        "vendor": {"type": "string", "description": "of the rasteriser, as OpenGL says it"},
        "driver": {"type": "string", "description": "of the rasteriser, with its version"}
      }
    },
    "reference": {"$ref": "#/definitions/reference"},
    "soft_reference": {"$ref": "#/definitions/reference"},
    "pixel_reference": {"$ref": "#/definitions/reference"},
    "sweep": {
      "type": "object",
      "description": "place on a curve over one quantity; break_point: first value at which the scene's tolerance is exceeded",
      "additionalProperties": false,
      "required": ["axis", "unit", "curve", "value"],
      "properties": {
        "axis": {"type": "string", "minLength": 1},
        "unit": {"type": "string"},
        "curve": {"type": "string", "minLength": 1},
        "value": {"type": "number"},
        "break_point": {"type": "number"}
      }
    },
    "figures": {
      "type": "object",
      "description": "numbers of the scored frame that only the technique knows; its entry in the catalogue explains them",
      "minProperties": 1,
      "additionalProperties": {"type": "number"}
    },
    "external": {
      "type": "object",
      "description": "of a renderer that is not ours, which the program called",
      "additionalProperties": false,
      "properties": {
        "title": {"type": "string", "minLength": 1},
        "source": {"type": "string", "minLength": 1},
        "revision": {"type": "string", "minLength": 1, "description": "of its sources, in the words of their repository"},
        "reported": {
          "type": "object",
          "description": "what the renderer says of its own cost; not measured here, and compared with nothing",
          "additionalProperties": false,
          "required": ["milliseconds"],
          "properties": {
            "milliseconds": {"$ref": "#/definitions/size", "description": "of a frame"},
            "device": {"type": "string", "minLength": 1}
          }
        }
      }
    },
    "tolerances": {
      "type": "object",
      "description": "the worst errors a viewer of this scene accepts, by metric",
      "minProperties": 1,
      "additionalProperties": {"$ref": "#/definitions/size"}
    },
    "tolerance": {
      "type": "object",
      "description": "in older records: one of the tolerances",
      "additionalProperties": false,
      "required": ["metric", "value"],
      "properties": {"metric": {"type": "string", "minLength": 1}, "value": {"$ref": "#/definitions/size"}}
    }
  },
  "allOf": [
    {
      "if": {"properties": {"status": {"enum": ["scored", "expected-failure"]}}},
      "then": {"oneOf": [{"required": ["accuracy", "reference"], "not": {"required": ["lod"]}},
                         {"required": ["lod"], "not": {"required": ["accuracy"]}}]},
      "else": {"required": ["reason"], "not": {"anyOf": [{"required": ["accuracy"]}, {"required": ["lod"]}]}}
    }
  ],
  "definitions": {
    "count": {"type": "integer", "minimum": 0},
    "size": {"type": "number", "minimum": 0},
    "by_pass": {
      "type": "array",
      "description": "of a frame, pass by pass: the G-buffer, the technique's own passes in their order, what lies between passes",
      "minItems": 1,
      "items": {
        "type": "object",
        "additionalProperties": false,
        "required": ["name", "runs", "fragments", "vertices", "draws"],
        "properties": {
          "name": {"type": "string", "minLength": 1},
          "runs": {"$ref": "#/definitions/count"},
          "milliseconds": {"$ref": "#/definitions/size"},
          "share": {"type": "number", "minimum": 0, "maximum": 1, "description": "of the frame's time"},
          "fragments": {"$ref": "#/definitions/count"},
          "vertices": {"$ref": "#/definitions/count"},
          "draws": {"$ref": "#/definitions/count"},
          "drawn_with": {"type": "string", "minLength": 1, "description": "hash of shaders and state, of a technique folder's own passes"},
          "bare": {"type": "object", "description": "in older records: the least that the pass needs, drawn by itself"}
        }
      }
    },
    "other_screen": {
      "type": "object",
      "description": "costs of the same frame on an image of another size",
      "additionalProperties": false,
      "required": ["size", "by_pass"],
      "properties": {
        "size": {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 2, "maxItems": 2},
        "by_pass": {"$ref": "#/definitions/by_pass"}
      }
    },
    "device": {
      "type": "array",
      "description": "costs of a frame on a graphics processor by its own clock, on larger images",
      "minItems": 1,
      "items": {
        "type": "object",
        "additionalProperties": false,
        "required": ["size", "median", "mad", "ratio", "processor", "by_pass"],
        "properties": {
          "size": {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 2, "maxItems": 2},
          "median": {"$ref": "#/definitions/size"},
          "mad": {"$ref": "#/definitions/size"},
          "ratio": {"$ref": "#/definitions/size"},
          "processor": {"$ref": "#/definitions/size"},
          "motion": {"$ref": "#/definitions/size"},
          "first": {"$ref": "#/definitions/size"},
          "by_pass": {"$ref": "#/definitions/by_pass"}
        }
      }
    },
    "gpu": {
      "type": "object",
      "description": "milliseconds of frames by a model, by card and size of the image; nothing was drawn on that card",
      "minProperties": 1,
      "additionalProperties": {
        "type": "object",
        "additionalProperties": false,
        "required": ["milliseconds", "least", "most", "waits", "by_pass"],
        "properties": {
          "milliseconds": {"$ref": "#/definitions/size"},
          "least": {"$ref": "#/definitions/size", "description": "if one rate of the card is twice what is said of it"},
          "most": {"$ref": "#/definitions/size", "description": "if one is half of it"},
          "waits": {"type": "boolean", "description": "for the program, which is in no number"},
          "by_pass": {"$ref": "#/definitions/terms"},
          "motion": {"$ref": "#/definitions/size", "description": "of the frame in motion, where it draws otherwise"},
          "motion_by_pass": {"$ref": "#/definitions/terms"},
          "cold": {"$ref": "#/definitions/size", "description": "of the first frame, where it draws otherwise"},
          "cold_by_pass": {"$ref": "#/definitions/terms"}
        }
      }
    },
    "terms": {
      "type": "array",
      "description": "milliseconds; a pass takes the largest of the first five, and the fixed term",
      "minItems": 1,
      "items": {
        "type": "object",
        "additionalProperties": false,
        "required": ["name", "arithmetic", "texture", "output", "geometry", "memory", "fixed"],
        "properties": {
          "name": {"type": "string", "minLength": 1},
          "arithmetic": {"$ref": "#/definitions/size"},
          "texture": {"$ref": "#/definitions/size"},
          "output": {"$ref": "#/definitions/size"},
          "geometry": {"$ref": "#/definitions/size"},
          "memory": {"$ref": "#/definitions/size"},
          "fixed": {"$ref": "#/definitions/size"}
        }
      }
    },
    "reference": {
      "type": "object",
      "additionalProperties": false,
      "required": ["oracle", "key", "samples", "sigma", "tools"],
      "properties": {
        "oracle": {"type": "string"},
        "key": {"type": "string"},
        "samples": {"$ref": "#/definitions/count"},
        "sigma": {"$ref": "#/definitions/size"},
        "tools": {"type": "object", "additionalProperties": {"type": "string"}},
        "content": {"type": "string", "description": "hash of the truth's pixels", "minLength": 1},
        "area": {
          "type": "object",
          "description": "the exact visible fraction of the same frame; rms: of the sampled truth against it, over the penumbra; rmse: of the cell against it",
          "additionalProperties": false,
          "required": ["key", "content", "rms", "rmse"],
          "properties": {
            "key": {"type": "string"},
            "content": {"type": "string"},
            "rms": {"$ref": "#/definitions/size"},
            "rmse": {"$ref": "#/definitions/size"}
          }
        }
      }
    }
  }
})";

/// Describes each metric of a group where other visitors write or read it.
class Describer {
public:
    explicit Describer(Json& object) : object_(object) {
        object_ = {{"type", "object"}, {"additionalProperties", false}, {"minProperties", 1}, {"required", Json::array()}};
    }

    void metric(const char* key, const metrics::Metric& line, const metrics::Values&) {
        Json& property = object_["properties"][key];
        property["description"] = std::string(line.meaning) + " [" + std::string(line.unit) + "]";
        if (line.list) property.update({{"type", "array"}, {"minItems", 1}});
        describe(line.range, line.list ? property["items"] : property);
        if (!line.optional) object_["required"].push_back(key);
    }

    template <typename Inner>
    void group(const char* key, bool, const Inner& inner) {
        Describer describer(object_["properties"][key]);
        inner(describer);
    }

private:
    static void describe(const metrics::Range& range, Json& type) {
        type["type"] = range.whole ? "integer" : "number";
        const auto limit = [&](double value) { return range.whole ? Json(static_cast<std::int64_t>(value)) : Json(value); };
        if (std::isfinite(range.least)) type["minimum"] = limit(range.least);
        if (std::isfinite(range.most)) type["maximum"] = limit(range.most);
    }

    Json& object_;
};

} // namespace

std::string recordSchema() {
    Json schema = Json::parse(withoutMetrics);
    for (const char* group : {"lod", "accuracy", "views", "sanity", "aliasing", "off_geometry_edges", "stability", "cost"}) {
        Describer describer(schema["properties"][group]);
        const metrics::Values values;
        records::metricFields(describer, metrics::linesOf(group), std::string_view(group).size() + 1, values);
    }
    Json& costs = schema["properties"]["cost"]["properties"];
    for (const char* passes : {"by_pass", "motion_by_pass", "cold_by_pass"})
        costs[passes] = {{"$ref", "#/definitions/by_pass"}};
    costs["other_screen"] = {{"$ref", "#/definitions/other_screen"}};
    costs["device"] = {{"$ref", "#/definitions/device"}};
    costs["gpu"] = {{"$ref", "#/definitions/gpu"}};
    Json& times = costs["time"]["properties"];
    for (const char* retired : {"bare", "bare_ratio"}) times[retired] = {{"$ref", "#/definitions/size"}};
    return schema.dump(2) + "\n";
}

} // namespace shadowbench
