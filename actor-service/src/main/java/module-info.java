/** Actors as services: a bus with typed topics and requests, and a broker that finds, starts and replaces providers. */
module io.troupe.service {
    requires transitive io.troupe.actor;
    requires io.troupe.common;

    exports io.troupe.broker;
    exports io.troupe.bus;

    opens io.troupe.broker to
            io.troupe.actor; // for the proxies of its actors
}
