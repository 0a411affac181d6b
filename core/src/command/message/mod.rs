//! What host and robot say to each other, each with its layout.

use super::field::Part;

/// How a message lies in its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Its CAN identifier; a smaller one goes first on a busy bus.
    pub id: u16,
    /// Its name.
    pub name: &'static str,
    /// What it says.
    pub meaning: &'static str,
    /// Its fields, one behind the other.
    pub fields: &'static [FieldLayout],
}

/// One field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldLayout {
    /// Its name.
    pub name: &'static str,
    /// What it says.
    pub meaning: &'static str,
    /// The integers it is made of.
    pub parts: &'static [Part],
}

impl Layout {
    /// How many bytes it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let parts = self.fields.iter().flat_map(|f| f.parts);
        parts.fold(0, |sum, part| sum.saturating_add(usize::from(part.bytes)))
    }
}

macro_rules! messages {
    ($(#[$set_doc:meta])* $set:ident {
        $(
            $(#[doc = $doc:literal])*
            $id:literal $name:ident {
                $($(#[doc = $field_doc:literal])* $field:ident: $kind:ty,)*
            }
        )*
    }) => {
        $(
            $(#[doc = $doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $name {
                $($(#[doc = $field_doc])* pub $field: $kind,)*
            }
        )*

        $(#[$set_doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(clippy::large_enum_variant)]
        pub enum $set {
            $($(#[doc = $doc])* $name($name),)*
        }

        impl $set {
            /// How every one of them lies in its bytes.
            pub const LAYOUTS: &'static [Layout] = &[$(Layout {
                id: $id,
                name: stringify!($name),
                meaning: concat!($($doc),*),
                fields: &[$(FieldLayout {
                    name: stringify!($field),
                    meaning: concat!($($field_doc),*),
                    parts: <$kind as Field>::PARTS,
                },)*],
            },)*];

            /// Puts it into bytes.
            #[must_use]
            pub fn packet(&self) -> Packet {
                let mut bytes = Vec::new();
                let id = match self {
                    $(Self::$name(message) => {
                        $(message.$field.put(&mut bytes);)*
                        $id
                    })*
                };
                Packet { id, bytes }
            }

            /// Takes it from bytes.
            ///
            /// # Errors
            /// [`PacketError`]
            pub fn read(packet: &Packet) -> Result<Self, PacketError> {
                let id = packet.id;
                let mut rest = packet.bytes.as_slice();
                let got = rest.len();
                let message = match id {
                    $($id => {
                        let wanted =
                            0_usize $(.saturating_add(bytes_of(<$kind as Field>::PARTS)))*;
                        if got != wanted {
                            return Err(PacketError::Length { id, got });
                        }
                        Self::$name($name {
                            $($field: Field::take(&mut rest).ok_or(PacketError::Value(id))?,)*
                        })
                    })*
                    _ => return Err(PacketError::UnknownMessage(id)),
                };
                Ok(message)
            }
        }

        $(
            impl From<$name> for $set {
                fn from(message: $name) -> Self {
                    Self::$name(message)
                }
            }
        )*
    };
}

const fn bytes_of(parts: &[Part]) -> usize {
    let mut sum = 0_usize;
    let mut rest = parts;
    while let Some((first, others)) = rest.split_first() {
        sum = sum.saturating_add(first.bytes as usize);
        rest = others;
    }
    sum
}

mod host;
mod robot;

pub use host::*;
pub use robot::*;
