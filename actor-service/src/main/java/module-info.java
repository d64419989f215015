/** Actors as services: a bus with typed topics and requests, and a broker that finds, starts and replaces providers. */
@SuppressWarnings("module") // the sister module is compiled after this one
module io.troupe.service {
    requires transitive io.troupe.actor;
    requires io.troupe.common;

    exports io.troupe.broker;
    exports io.troupe.bus;
    exports io.troupe.bus.internal to
            io.troupe.services; // for the names of its ports

    opens io.troupe.broker to
            io.troupe.actor; // for the proxies of its actors
}
