//! What the behaviour tests of the whole share.
