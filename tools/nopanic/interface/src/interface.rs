//! The public functions, from the JSON that rustdoc writes of a crate.

use crate::{Function, Result};
use serde_json::Value;
use std::collections::BTreeSet;

/// All functions and methods that rustdoc lists, without those that `derive` wrote and those that other crates give to any
/// type.
pub(crate) fn functions(json: &Value) -> Result<BTreeSet<Function>> {
    let items = json["index"].as_object().ok_or("rustdoc's JSON has no index")?;
    let mut functions = BTreeSet::new();
    for item in items.values().filter(|item| item["crate_id"] == 0) {
        let inner = &item["inner"];
        // Methods have no path of their own.
        if inner.get("function").is_some() {
            functions.extend(path(json, &item["id"]).map(Function::Free));
        } else if let Some(implementation) = inner.get("impl") {
            if is_written(item) {
                of_impl(json, implementation, &mut functions)?;
            }
        } else if let Some(definition) = inner.get("trait") {
            let of_trait = path(json, &item["id"]).ok_or("a trait without a path")?;
            // A method without a body is that of its implementations.
            for (name, method) in methods(json, definition) {
                if method["inner"]["function"]["has_body"] == true {
                    functions.insert(Function::Any { of_trait: of_trait.clone(), name });
                }
            }
        }
    }
    Ok(functions)
}

/// Whether an `impl` stands in the sources.
fn is_written(item: &Value) -> bool {
    let implementation = &item["inner"]["impl"];
    let derived = item["attrs"].to_string().contains("automatically_derived");
    !derived && implementation["is_synthetic"] == false && implementation["blanket_impl"].is_null()
}

fn of_impl(json: &Value, implementation: &Value, functions: &mut BTreeSet<Function>) -> Result<()> {
    let of_trait = match &implementation["trait"] {
        Value::Null => None,
        of_trait => Some(path_or_name(json, of_trait)?),
    };
    let of = type_name(json, &implementation["for"])?;
    for (name, _) in methods(json, implementation) {
        functions.insert(match (&of, &of_trait) {
            (Some(of), of_trait) => Function::Method { of: of.clone(), of_trait: of_trait.clone(), name },
            (None, Some(of_trait)) => Function::Any { of_trait: of_trait.clone(), name },
            (None, None) => return Err("an inherent method of any type".into()),
        });
    }
    Ok(())
}

/// The functions among a trait's or an implementation's items, by their names.
fn methods<'j>(json: &'j Value, of: &'j Value) -> impl Iterator<Item = (String, &'j Value)> {
    let items = of["items"].as_array().into_iter().flatten();
    items.filter_map(|id| {
        let item = &json["index"][id.to_string()];
        item["inner"].get("function")?;
        Some((item["name"].as_str()?.to_string(), item))
    })
}

/// The name of a type as symbols have it; `None` for a type parameter, and for references, arrays and slices.
fn type_name(json: &Value, of: &Value) -> Result<Option<String>> {
    let (kind, inner) = of.as_object().and_then(|of| of.iter().next()).ok_or("a type")?;
    Ok(match kind.as_str() {
        "resolved_path" => {
            // Symbols name what an alias stands for.
            match json["index"][inner["id"].to_string()]["inner"].get("type_alias") {
                Some(alias) => type_name(json, &alias["type"])?,
                None => Some(path_or_name(json, inner)?),
            }
        }
        "generic" => None,
        // Of elements of any type, in this library.
        "borrowed_ref" | "array" | "slice" => None,
        "primitive" => Some(inner.as_str().ok_or("a primitive type's name")?.to_string()),
        "tuple" if inner.as_array().is_some_and(Vec::is_empty) => Some("()".to_string()),
        _ => return Err(format!("a kind of type that this program does not know: {kind}").into()),
    })
}

/// Where an item is defined.
fn path(json: &Value, id: &Value) -> Option<String> {
    let parts = json["paths"][id.to_string()]["path"].as_array()?;
    Some(parts.iter().filter_map(Value::as_str).collect::<Vec<_>>().join("::"))
}

fn path_or_name(json: &Value, of: &Value) -> Result<String> {
    let name = || of["path"].as_str().map(str::to_string);
    Ok(path(json, &of["id"]).or_else(name).ok_or("a path without a name")?)
}
