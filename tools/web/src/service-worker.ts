// Keeps the page for the times without a network. The page is one file; nothing else is ever asked for.
const scope = globalThis as unknown as ServiceWorkerGlobalScope;
interface ServiceWorkerGlobalScope extends EventTarget {
  skipWaiting(): Promise<void>;
  clients: { claim(): Promise<void> };
}
interface Lasting extends Event {
  waitUntil(p: Promise<unknown>): void;
}
interface Asked extends Event {
  request: Request;
  respondWith(r: Promise<Response>): void;
}
const store = "deck-VERSION";

scope.addEventListener("install", (e) => {
  (e as Lasting).waitUntil(caches.open(store).then((c) => c.addAll(["./", "index.html"])).then(() => scope.skipWaiting()));
});
scope.addEventListener("activate", (e) => {
  const clean = async () => {
    for (const name of await caches.keys()) if (name !== store && name.startsWith("deck-")) await caches.delete(name);
    await scope.clients.claim();
  };
  (e as Lasting).waitUntil(clean());
});
scope.addEventListener("fetch", (e) => {
  const asked = e as Asked;
  asked.respondWith(caches.match(asked.request, { ignoreSearch: true }).then((kept) => kept ?? fetch(asked.request)));
});
