//! A register of components: a line for each, with its file, its type and its role.

macro_rules! components {
    ($list:ident, $role:ident; $($module:ident: $type:ident, $about:literal;)*) => {
        $(pub(crate) mod $module; pub use $module::$type;)*
        /// The components that a scene may name.
        pub const $list: &[crate::component::Entry] = &[$(crate::component::Entry {
            name: stringify!($module),
            about: $about,
            keys: $module::KEYS,
            role: crate::component::Role::$role,
            build: |settings| {
                let make: fn(&crate::settings::Settings) -> Box<dyn crate::component::Component> =
                    |settings| Box::new($type::new(settings));
                crate::component::registered(stringify!($module), $module::KEYS, settings, make)
            },
        }),*];
    };
}
pub(crate) use components;
