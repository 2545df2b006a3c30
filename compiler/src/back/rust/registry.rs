//! `mod.rs` of the generated folder: the modules, and the list of compiled models.

use super::{EmitError, names, runtime_path, text};
use quote::{format_ident, quote};

/// A model as the list shows it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Mounted {
    /// Its name, also that of its module.
    pub name: String,
    /// Path of its spec for `include_str!`, seen from `mod.rs`, or absolute.
    pub spec: String,
    /// Its parts: the name by which the spec finds each, and its path for `include_str!`.
    pub parts: Vec<(String, String)>,
}

/// The text of `mod.rs`, without its header.
///
/// # Errors
/// When the runtime path is no path.
pub fn registry(models: &[Mounted], runtime: &str) -> Result<String, EmitError> {
    let runtime = runtime_path(runtime)?;
    let mut file = text::pretty(quote! {
        #![doc = " The compiled models."]
    })?;
    file.push('\n');
    let modules = models.iter().map(|model| format_ident!("{}", model.name));
    file.push_str(&text::pretty(quote!(#(pub mod #modules;)*))?);
    file.push('\n');
    let entries = models.iter().map(|model| {
        let (module, name, spec) =
            (format_ident!("{}", model.name), format_ident!("{}", names::camel(&model.name)), &model.spec);
        let parts = model.parts.iter().map(|(name, path)| quote!((#name, include_str!(#path))));
        quote! {
            #runtime::registry::Entry {
                compiled: &#runtime::hybrid::Hybrid::<
                    #module::#name,
                    { #module::STATES },
                    { #module::PARAMETERS },
                    { #module::INTEGRALS },
                >(::core::marker::PhantomData),
                spec: include_str!(#spec),
                parts: &[#(#parts),*],
            }
        }
    });
    file.push_str(&text::pretty(quote! {
        /// The compiled models, each with the spec that it was compiled from.
        pub static MODELS: &[#runtime::registry::Entry] = &[#(#entries),*];
    })?);
    Ok(file)
}
