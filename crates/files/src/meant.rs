//! Suggestions for an unknown name of a template, a parameter or a material.
//!
//! A typing error leads to the nearest name, a synonym to the name that it stands for. The synonyms
//! come from the catalogue for templates and parameters, and from the lists below for parameters
//! and for the trade and American names of materials.

use crate::materials::{catalogue_names, known_materials, material_group, material_named};
use crate::names::{did_you_mean, folded, nearest, shown};
use sheetwright::material::Material;
use sheetwright::template::{Parameter, Template, catalogue};

/// The most templates that a hint names.
const MOST_NAMED: usize = 4;
/// The most materials that a hint suggests; above, it suggests the first of each group.
const MOST_MEANT: usize = 8;
/// The most materials of a design that a hint names.
const MOST_OWN: usize = 20;

/// Synonyms of materials, by their group, the first part of the material's name.
const MATERIAL_WORDS: [(&str, &[&str]); 20] = [
    ("aluminium", &["aluminum", "alu", "dural", "alloy", "metal", "sheetmetal"]),
    ("brass", &["metal"]),
    ("canvas", &["fabric", "cloth", "textile", "cotton", "tarp", "tarpaulin", "denim", "linen"]),
    ("card", &["cardstock", "bristol", "manila"]),
    ("cardboard", &["board", "greyboard", "grayboard", "chipboard", "pasteboard", "millboard"]),
    ("copper", &["metal"]),
    ("eva", &["foam", "foamie"]),
    ("felt", &["wool"]),
    ("galvanised", &["galvanized", "galv", "gi", "zinc", "zintec", "metal", "sheetmetal"]),
    ("leather", &["hide", "suede", "cowhide"]),
    ("mdf", &["hdf", "hardboard", "fibreboard", "fiberboard", "masonite"]),
    ("paper", &["kraft", "tissue", "parchment"]),
    ("pet", &["petg", "plastic"]),
    ("plywood", &["ply", "wood", "okoume", "birch", "marine"]),
    ("polypropylene", &["pp", "plastic", "polyprop", "pvc", "styrene", "acrylic"]),
    ("ripstop", &["nylon", "spinnaker", "parachute", "fabric", "cloth"]),
    ("sailcloth", &["sail", "dacron", "polyester", "fabric", "cloth"]),
    ("stainless", &["inox", "304", "metal"]),
    ("steel", &["iron", "tin", "tinplate", "corten", "mild", "metal", "sheetmetal"]),
    ("veneer", &["wood"]),
];

/// The usual word in the name of a parameter, and its synonyms.
const PARAMETER_WORDS: [(&str, &[&str]); 9] = [
    ("diameter", &["dia", "diam", "d", "ø", "radius", "r", "bore", "round", "size"]),
    ("height", &["h", "high", "tall", "rise", "drop"]),
    ("width", &["w", "wide", "beam", "breadth", "side"]),
    ("length", &["l", "len", "long", "loa"]),
    ("depth", &["deep"]),
    (
        "pieces",
        &["n", "count", "number", "parts", "sections", "segments", "panels", "gores", "seams"],
    ),
    ("angle", &["degrees", "deg", "bend"]),
    ("radius", &["r", "rad"]),
    ("units", &["unit"]),
];

/// The material of a name, from `own` or the catalogue. The error is a message and a hint.
pub(crate) fn material_meant(wanted: &str, own: &[Material]) -> Result<Material, (String, String)> {
    material_named(wanted, own).ok_or_else(|| {
        (format!("the material {} is not known", shown(wanted)), material_hint(wanted, own))
    })
}

/// The hint for a name that neither `own` nor the catalogue has.
fn material_hint(wanted: &str, own: &[Material]) -> String {
    let known: Vec<&str> = known_materials(own).iter().map(|m| &m.name[..]).collect();
    let words = words_of(wanted);
    let is_called = |group: &str, others: &[&str]| {
        words.iter().any(|word| word == group || others.contains(&word.as_str()))
    };
    let groups: Vec<&str> = MATERIAL_WORDS
        .iter()
        .filter(|(group, others)| is_called(group, others))
        .map(|(group, _)| *group)
        .collect();
    let mut meant: Vec<&str> =
        known.iter().copied().filter(|name| groups.contains(&material_group(name))).collect();
    if meant.len() > MOST_MEANT {
        meant.dedup_by_key(|name| material_group(name));
    }
    // One word for a group means all of it; with a thickness, the nearest name.
    let is_a_group = words.len() == 1 && !meant.is_empty();
    let near = nearest(wanted, known.iter().copied()).filter(|_| !is_a_group);
    let question = match (near, one_of(&meant)) {
        (Some(name), _) => format!("Did you mean {}? ", shown(name)),
        (None, meant) if meant.is_empty() => meant,
        (None, meant) => format!("Did you mean {meant}? "),
    };
    let mut listed: Vec<String> = own.iter().take(MOST_OWN).map(|m| shown(&m.name)).collect();
    if own.len() > MOST_OWN {
        listed.push(format!("{} more of the design", own.len() - MOST_OWN));
    }
    listed.push(catalogue_names());
    format!("{question}Known here: {}.", listed.join("; "))
}

/// A question that suggests templates for an unknown name; empty without a suggestion.
pub(crate) fn template_question(wanted: &str) -> String {
    let found = templates_meant(wanted);
    match found.is_empty() {
        true => String::new(),
        false => format!("Did you mean {}? ", one_of(&found)),
    }
}

/// The names of templates to suggest, by the first of these rules that finds any: the name or a
/// search word is `wanted`; the nearest name; the nearest search word; the name begins with
/// `wanted`; the title or the users contain all its words.
fn templates_meant(wanted: &str) -> Vec<&'static str> {
    let words = words_of(wanted);
    let has_all = |texts: &[&str]| {
        let all: Vec<String> = texts.iter().flat_map(|text| words_of(text)).collect();
        !words.is_empty() && words.iter().all(|word| all.contains(word))
    };
    let named = |is_meant: &dyn Fn(&Template) -> bool| -> Vec<&'static str> {
        catalogue().iter().filter(|t| is_meant(t)).take(MOST_NAMED).map(|t| t.name).collect()
    };
    let by_word = named(&|t| has_all(&[t.name]) || t.words.iter().any(|text| has_all(&[text])));
    if !by_word.is_empty() {
        return by_word;
    }
    if let Some(name) = nearest(wanted, catalogue().iter().map(|t| t.name)) {
        return vec![name];
    }
    if let Some(word) = nearest(wanted, catalogue().iter().flat_map(|t| t.words.iter().copied())) {
        return named(&|t| t.words.contains(&word));
    }
    let begins = folded(wanted);
    let by_beginning = named(&|t| begins.chars().count() >= 3 && t.name.starts_with(&begins));
    if !by_beginning.is_empty() {
        return by_beginning;
    }
    named(&|t| has_all(&[t.title, t.who]))
}

/// The hint for a parameter that the template does not have; `others` are the settings of every
/// template.
pub(crate) fn parameter_hint(wanted: &str, template: &Template, others: &[&str]) -> String {
    let mut known: Vec<&str> = template.parameters.iter().map(|p| p.name).collect();
    known.extend(others);
    let list = did_you_mean(wanted, &known);
    if nearest(wanted, known.iter().copied()).is_some() {
        return list;
    }
    let wanted = folded(wanted);
    let meant = parameters_meant(&wanted, template);
    match &meant[..] {
        [] => list,
        [one] => format!("Did you mean {} ({})? {list}", shown(one.name), one.meaning),
        several => {
            let names: Vec<&str> = several.iter().map(|p| p.name).collect();
            format!("Did you mean {}? {list}", one_of(&names))
        }
    }
}

/// The parameters whose name begins with `wanted` or has it as a part, else those whose meaning
/// contains it. If there are none, searches for the usual word in this way, then for its synonyms.
fn parameters_meant(wanted: &str, template: &Template) -> Vec<&'static Parameter> {
    let usual = PARAMETER_WORDS.iter().filter(|(_, others)| others.contains(&wanted));
    let alike = usual.flat_map(|(word, others)| [*word].into_iter().chain(others.iter().copied()));
    for word in [wanted].into_iter().chain(alike) {
        let of_name = |p: &&Parameter| {
            let begins = word.chars().count() >= 3 && p.name.starts_with(word);
            begins || p.name.split('-').any(|part| part == word)
        };
        let of_meaning = |p: &&Parameter| words_of(p.meaning).iter().any(|said| said == word);
        let by_name: Vec<&Parameter> = template.parameters.iter().filter(of_name).collect();
        let found = if by_name.is_empty() {
            template.parameters.iter().filter(of_meaning).take(MOST_NAMED).collect()
        } else {
            by_name
        };
        if !found.is_empty() {
            return found;
        }
    }
    Vec::new()
}

/// The words of a text, in small letters.
fn words_of(text: &str) -> Vec<String> {
    let text = folded(text);
    let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_owned).collect()
}

/// `'a', 'b' or 'c'`.
fn one_of(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| shown(name)).collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::template::template;

    #[test]
    fn other_words_lead_to_templates() {
        for (wanted, meant) in [
            ("lamp", "'lampshade'"),
            ("Lamp shade", "'lampshade'"),
            ("kone", "'cone'"),
            ("half-sphere", "'dome' or 'hemisphere'"),
            ("Zepelin", "'airship'"),
            ("hemi", "'hemisphere'"),
        ] {
            let said = template_question(wanted);
            assert_eq!(said, format!("Did you mean {meant}? "), "{wanted}");
        }
        assert_eq!(template_question("xyzzy"), "");
    }

    #[test]
    fn other_words_lead_to_parameters() {
        for (name, wanted, meant) in [
            ("lampshade", "height", "'slant' (height along the side, as the shade is sold)"),
            ("dome", "dia", "'diameter' (diameter at the foot)"),
            ("dome", "Ø", "'diameter' (diameter at the foot)"),
            ("cone", "dia", "'bottom' or 'top'"),
            ("dome", "segments", "'gores'"),
            ("square-to-round", "offset", "'offset-x'"),
            ("tent", "width", "'front-width', 'middle-width' or 'rear-width'"),
        ] {
            let said = parameter_hint(wanted, template(name).unwrap(), &["material"]);
            assert!(said.starts_with(&format!("Did you mean {meant}")), "{wanted}: {said}");
            assert!(said.contains("? Known here: "), "{said}");
        }
    }

    #[test]
    fn other_words_lead_to_materials() {
        for (wanted, meant) in [
            (
                "galvanised",
                "'galvanised-26ga', 'galvanised-24ga', 'galvanised-22ga', 'galvanised-20ga' or \
                 'galvanised-18ga'",
            ),
            ("Galvanized steel", "'galvanised-26ga' or 'steel-0.8mm'"),
            ("steel-1m", "'steel-1mm'"),
            ("inox", "'stainless-0.8mm', 'stainless-1mm', 'stainless-1.5mm' or 'stainless-2mm'"),
            ("plastic", "'pet-0.5mm', 'pet-1mm', 'polypropylene-0.5mm' or 'polypropylene-0.8mm'"),
            ("foam", "'eva-2mm', 'eva-5mm' or 'eva-10mm'"),
            ("nylon", "'ripstop'"),
            ("dacron", "'sailcloth'"),
            ("fabric", "'canvas', 'ripstop' or 'sailcloth'"),
            (
                "metal",
                "'aluminium-1mm', 'brass-0.5mm', 'copper-0.6mm', 'galvanised-26ga', \
                 'stainless-0.8mm' or 'steel-0.8mm'",
            ),
        ] {
            let said = material_hint(wanted, &[]);
            assert!(said.starts_with(&format!("Did you mean {meant}? Known here: ")), "{said}");
        }
        assert!(material_hint("papper", &[]).starts_with("Did you mean 'paper'? "));
        assert!(material_hint("xyzzy", &[]).starts_with("Known here: "));
    }

    /// A name that no material has would lead nowhere.
    #[test]
    fn the_words_are_of_materials_that_are_there() {
        for (stem, _) in MATERIAL_WORDS {
            assert!(
                known_materials(&[]).iter().any(|m| m.name.split('-').next() == Some(stem)),
                "{stem}"
            );
        }
    }
}
