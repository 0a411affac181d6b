//! Named sets of capacities. Any other is a call of the same macro away.

/// Names the core's types for one set of capacities.
macro_rules! capacities {
    ($(#[$doc:meta])* $name:ident: options $n:literal, categories $c:literal, features $f:literal,
     entities $e:literal, words $w:literal, frame $frame:literal, outbox $out:literal,
     sensors $sensors:literal) => {
        $(#[$doc])*
        pub mod $name {
            /// Options per category, actions included.
            pub const OPTIONS: usize = $n;
            /// Categories, the action's included.
            pub const CATEGORIES: usize = $c;
            /// Features of a thing.
            pub const FEATURES: usize = $f;
            /// Things in a scene.
            pub const ENTITIES: usize = $e;
            /// Words in a sentence.
            pub const WORDS: usize = $w;
            /// Bytes of the longest frame before stuffing.
            pub const FRAME: usize = $frame;
            /// Bytes of sensors' tables: one per option, squared.
            pub const SENSORS: usize = $sensors;
            /// [`crate::vocabulary::Vocabulary`] of these capacities.
            pub type Vocabulary = crate::vocabulary::Vocabulary<$n, $c, $f>;
            /// [`crate::scene::Scene`] of these capacities.
            pub type Scene = crate::scene::Scene<$e, $f>;
            /// [`crate::scene::Entity`] of these capacities.
            pub type Entity = crate::scene::Entity<$f>;
            /// [`crate::sentence::Word`] of these capacities.
            pub type Word = crate::sentence::Word<$c, $n>;
            /// [`crate::sentence::Sentence`] of these capacities.
            pub type Sentence = crate::sentence::Sentence<$w, $c, $n>;
            /// [`crate::observations::Observations`] of these capacities.
            pub type Observations = crate::observations::Observations<$w, $c, $n>;
            /// [`crate::intent::Intent`] of these capacities.
            pub type Intent = crate::intent::Intent<$c>;
            /// [`crate::decision::Decision`] of these capacities.
            pub type Decision = crate::decision::Decision<$c>;
            /// [`crate::trace::Trace`] of these capacities.
            pub type Trace = crate::trace::Trace<$c, $n>;
            /// [`crate::protocol::message::ToUnit`] of these capacities.
            pub type ToUnit = crate::protocol::message::ToUnit<$n, $c, $f>;
            /// [`crate::protocol::message::ToHost`] of these capacities.
            pub type ToHost = crate::protocol::message::ToHost<$n, $c>;
            /// [`crate::protocol::link::Link`] of these capacities.
            pub type Link = crate::protocol::link::Link<$frame>;
            /// [`crate::unit::Unit`] of these capacities.
            pub type Unit = crate::unit::Unit<$n, $c, $f, $e, $w, $frame, $out, $sensors>;
        }
    };
}

capacities! {
    /// What a gesture unit with 16 KiB of RAM to spare holds: the paper's vocabulary twice over.
    board: options 16, categories 8, features 16, entities 16, words 6, frame 256, outbox 1536,
    sensors 512
}

capacities! {
    /// What a host or a large board holds.
    large: options 64, categories 16, features 32, entities 128, words 8, frame 1024, outbox 16384,
    sensors 24576
}
