package io.troupe.bench.worlds;

/** One way to simulate a {@link TiledScene}. Its devices have been read once when it is new. */
interface BenchWorld {
    /** One interval of simulated time: commands by the newest readings, the physics steps, all devices. */
    void advance();

    /** The newest ones; the same object always. */
    Readings readings();
}
