// Nothing: there is no precompiled header without a source.
