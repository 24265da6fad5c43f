//! A register of components: a line for each, which is its file, its type and what it is.

macro_rules! components {
    ($list:ident, $role:ident; $($module:ident: $type:ident, $about:literal;)*) => {
        $(pub(crate) mod $module; pub use $module::$type;)*
        /// What a scene may name.
        pub const $list: &[crate::component::Entry] = &[$(crate::component::Entry {
            name: stringify!($module),
            about: $about,
            keys: $module::KEYS,
            role: crate::component::Role::$role,
            build: |settings| match settings.fault($module::KEYS) {
                Some(fault) => crate::component::misnamed(format!("the force `{}` {fault}", stringify!($module))),
                None => Box::new($type::new(settings)),
            },
        }),*];
    };
}
pub(crate) use components;
