// libdeck: the contacts of Radioss and OpenRadioss Starter decks. This header brings what most
// programs need, and this comment is their manual. Every line of code in it is compiled and run by
// the tests (tests/consumer/main.cpp); details are in the headers that are named.
//
// LOADING A DECK
//
// load() reads a file with everything that it includes. The result holds the deck, or an error
// where the main file cannot be read; every other fault of a deck is a finding.
//
//   const auto result = deck::load(argv[1]);
//   if (!result) {
//     std::fprintf(stderr, "%s\n", result.error().message.c_str());
//     return 3;
//   }
//   const deck::LoadedDeck& loaded = *result;
//
// A LoadedDeck makes each thing (model, interfaces, contacts, forces) when it is first asked for,
// and keeps it. LoadOptions has the number of threads, which changes no result, and the bounds on
// memory and size.
//
// INTERFACES AND EFFECTIVE VALUES
//
// A field has the value that the solver uses, and where it comes from: the card, a
// /DEFAULT/INTER block, the built-in default, the mesh. Fields have the names of the manual.
//
//   for (const deck::InterType7& inter : loaded.interfaces().type7)
//     std::printf("TYPE7 %lld Gapmin %g Inacti %lld\n", static_cast<long long>(inter.id),
//                 inter.Gapmin.value, static_cast<long long>(inter.Inacti.value));
//
// Interfaces of every type, and all of their fields:
//
//   for (const deck::InterBase* inter : loaded.interfaces().ordered)
//     deck::for_each_field(*inter, [&](std::string_view name, const auto& field) {
//
// CONTACTS AND PENETRATIONS
//
// A contact has one secondary and one main side; a TYPE19 has up to three. contacts.hpp has their
// nodes, segments, gaps and stiffness.
//
//   const deck::Scene& scene = loaded.scene();
//   for (const deck::Contact& contact : scene.contacts)
//     std::printf("interface %lld: gaps up to %g, %zu %s%s\n",
//                 static_cast<long long>(contact.inter->id), contact.max_gap,
//                 contact.penetrations.size(), contact.ties() ? "pairs tied" : "penetrations",
//                 contact.evaluated ? "" : " (not evaluated)");
//
// make_view() gives the penetrations of all contacts with the ids of nodes and elements, deepest
// first. The depth is the gap minus the distance.
//
//   for (const deck::NamedPenetration& p : deck::make_view(scene).penetrations) {
//     const deck::PenetrationRow& row = scene.contacts[p.contact].penetrations[p.row];
//     const auto node = static_cast<long long>(p.secondary[0]);
//     std::printf("node %lld: %g of a gap of %g\n", node, row.depth, row.gap);
//   }
//
// FINDINGS AND VERDICT
//
// findings() holds what is wrong in reading, model and contacts, each with its place; run_lint()
// of lint.hpp adds the rules. The verdict says in sentences what `deck gaps` says.
//
//   for (const deck::Diagnostic& finding : loaded.findings().all())
//     std::printf("%s: %s\n", loaded.deck().sources.where(finding.span).c_str(),
//                 finding.message.c_str());
//   std::printf("%s\n", deck::verdict_of(loaded).text.c_str());
//
// FIRST CYCLE
//
// Forces, energies and time steps of the first force evaluation, by contact, and the sums on nodes.
//
//   const deck::cycle::SceneOutcome& outcome = loaded.cycle().outcome;
//   std::printf("largest nodal force %g\n", outcome.largest_nodal_force);
//   std::printf("time step of the contacts %g\n", outcome.contact_dt);
//
// EDITING
//
// An Edit collects changes and writes all files or none: in place (save), into a folder (save_to)
// or as a patch (diff). It sets fields of any block, moves nodes, inserts and removes blocks. A
// number is in working units; a text is written as it is.
//
//   deck::Edit edit(loaded);
//   edit.set(loaded.interfaces().find(1), "Gapmin", 0.8);
//   if (const auto saved = edit.save_to(directory); !saved) {
//     std::fprintf(stderr, "%s\n", saved.error().message.c_str());
//
// The first change that cannot be made is kept with its place (Edit::status) and nothing is
// written. Repairs of contacts and conversions (version, units, ids, one file without includes) are
// functions of edit.hpp. They give a Rewrite: the text edits, and what they would lose.
//
// UNITS, LIFETIME, THREADS, ERRORS
//
// Lengths, forces and times are in the working units of /BEGIN. Ids are those of the deck (64 bits,
// signed); positions (NodeIndex, 32 bits) index the arrays of the model.
// Parts of a LoadedDeck refer to one another and stay where they are until it ends, also when it is
// moved; a scene stays until set_scene_options() or drop_scene().
// Use one LoadedDeck in one thread at a time, since asking makes things; different threads may use
// different decks. There is no global state.
// Bad input never throws: a Result holds a value or an Error. The library prints nothing.
#pragma once
#include "deck/contacts.hpp"
#include "deck/edit.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/verdict.hpp"
