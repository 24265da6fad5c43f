//! The book and the README say what is so.

mod pages;
mod readme;
