//! Indices as types, so that a primitive is never looked up in the list of instances.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// For indexing into a slice.
            #[must_use]
            #[inline]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

id! {
    /// A primitive within its geometry: the triangle of a mesh, the shape of a list.
    PrimitiveId
}
id! {
    /// A geometry within its scene: one mesh, one list of shapes.
    GeometryId
}
id! {
    /// A placed geometry within its scene.
    InstanceId
}
