"""From a mechanism to its loop equations and its velocity equation."""
