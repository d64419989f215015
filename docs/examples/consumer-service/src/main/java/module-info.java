/** On the module path: the library calls the types of this module, so their package is opened. */
module hello {
    requires io.troupe.bus.nats;
    requires io.troupe.service;

    opens hello;
}
