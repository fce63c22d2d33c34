// libdeck reads Starter decks of Radioss and OpenRadioss and evaluates their contacts. Most
// programs include only this header; this comment is the manual. The tests compile and run every
// line of code in it (tests/consumer/main.cpp). The headers named below have the details.
//
// LOADING A DECK
//
// load() reads a file and all files that it includes. The result is the deck, or an error if the
// main file cannot be read. Every other problem of the deck is a finding.
//
//   const auto result = deck::load(argv[1]);
//   if (!result) {
//     std::fprintf(stderr, "%s\n", result.error().message.c_str());
//     return 3;
//   }
//   const deck::LoadedDeck& loaded = *result;
//
// A LoadedDeck builds model, interfaces, contacts and forces at the first call of their getter and
// keeps them. LoadOptions sets the number of threads (results do not depend on it) and the limits
// of memory and size.
//
// INTERFACES AND EFFECTIVE VALUES
//
// Each field has its effective value (the one that the solver uses) and its origin: the card, a
// /DEFAULT/INTER block, the built-in default or the mesh. Fields have the names of the manual.
//
//   for (const deck::InterType7& inter : loaded.interfaces().type7)
//     std::printf("TYPE7 %lld Gapmin %g Inacti %lld\n", static_cast<long long>(inter.id),
//                 inter.Gapmin.value, static_cast<long long>(inter.Inacti.value));
//
// This loop visits interfaces of all types and all of their fields:
//
//   for (const deck::InterBase* inter : loaded.interfaces().ordered)
//     deck::for_each_field(*inter, [&](std::string_view name, const auto& field) {
//
// CONTACTS AND PENETRATIONS
//
// A contact has one secondary side and one main side. One interface can become several contacts: a
// TYPE19 becomes up to three. contacts.hpp has their nodes, segments, gaps and stiffness.
//
//   const deck::Scene& scene = loaded.scene();
//   for (const deck::Contact& contact : scene.contacts)
//     std::printf("interface %lld: gaps up to %g, %zu %s%s\n",
//                 static_cast<long long>(contact.inter->id), contact.max_gap,
//                 contact.penetrations.size(), contact.is_tied_contact() ? "ties" : "penetrations",
//                 contact.evaluated ? "" : " (not evaluated)");
//
// make_view() lists the penetrations of all contacts with the ids of their nodes and elements, the
// deepest first. The depth is the gap minus the distance.
//
//   for (const deck::NamedPenetration& p : deck::make_view(scene).penetrations) {
//     const deck::PenetrationRow& row = scene.contacts[p.contact].penetrations[p.row];
//     const auto node = static_cast<long long>(p.secondary[0]);
//     std::printf("node %lld: %g of a gap of %g\n", node, row.depth, row.gap);
//   }
//
// FINDINGS AND VERDICT
//
// findings() lists the problems found while reading the deck and building model and contacts, each
// with its place. run_lint() in lint.hpp also checks the rules. `deck gaps` prints this verdict.
//
//   for (const deck::Finding& finding : loaded.findings().all())
//     std::printf("%s: %s\n", loaded.deck().sources.where(finding.span).c_str(),
//                 finding.message.c_str());
//   std::printf("%s\n", deck::verdict_of(loaded).text.c_str());
//
// FIRST CYCLE
//
// cycle() evaluates all contacts once: forces, energies and time steps per contact, sums per node.
//
//   const deck::cycle::SceneOutcome& outcome = loaded.cycle().outcome;
//   std::printf("largest force on a node %g\n", outcome.largest_nodal_force);
//   std::printf("time step of the contacts %g\n", outcome.contact_dt);
//
// EDITING
//
// An Edit collects changes. save() writes them in place, save_to() into a folder, all files or
// none; diff() returns them as a patch. An Edit sets fields of any block, moves nodes, inserts and
// removes blocks. Numbers are in working units; a text is written into the cell unchanged.
//
//   deck::Edit edit(loaded);
//   edit.set(loaded.interfaces().find(1), "Gapmin", 0.8);
//   if (const auto saved = edit.save_to(directory); !saved) {
//     std::fprintf(stderr, "%s\n", saved.error().message.c_str());
//
// If a change is impossible, nothing is written; Edit::status() returns the first such error with
// its place. edit.hpp also has functions that repair interface cards.
//
// CONVERSIONS
//
// A conversion (version, units, ids, one file without includes, TYPE19 to TYPE7 and TYPE11, some
// interfaces only) returns text edits, losses and refusals. With a refusal nothing may be written.
//
//   const deck::Rewrite rewrite = deck::to_version(loaded, 2026);
//   for (const deck::LossEntry& loss : rewrite.losses)
//     std::printf("%s %s: %s\n", loss.keyword.c_str(), loss.field.c_str(), loss.note.c_str());
//   const auto files = deck::apply_rewrite(loaded.deck().sources, rewrite);  // texts by path
//
// UNITS, LIFETIME, THREADS, ERRORS
//
// Lengths, forces and times are in the working units of /BEGIN. Ids are those of the deck (64 bits,
// signed); positions (NodeIndex, 32 bits) index the arrays of the model.
// References into a LoadedDeck stay valid for its lifetime, also after it is moved. Exceptions:
// set_scene_options() and drop_scene() free the scene; loaded_deck.hpp says where others end.
// A LoadedDeck is not thread-safe, because getters build at their first call. Different threads may
// use different decks; there is no global state.
// Bad input never throws: a Result is a value or an Error. The library prints nothing.
#pragma once
#include "deck/contacts.hpp"
#include "deck/edit.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/verdict.hpp"
