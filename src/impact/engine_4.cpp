#include "impact/engine.inl"

template class ricochet::Engine<4>;
