// All that a program needs: load a deck, look at its values, contacts and penetrations, hear the
// verdict, change it.
//
//   const auto loaded = deck::load("car_0000.rad");
//   if (!loaded) ...loaded.error().message
//   for (const deck::InterType7& inter : loaded->interfaces().type7) ...inter.Gapmin.value
#pragma once
#include "deck/contact/view.hpp"
#include "deck/edit/edit.hpp"
#include "deck/front/loaded_deck.hpp"
#include "deck/verdict.hpp"
