"""All tables of the documents that come from runs."""

from . import automaton, contact, fits, rivals

TABLES = [*contact.TABLES, *automaton.TABLES, *fits.TABLES, *rivals.TABLES]
