package io.troupe.bench.worlds;

/** One way to simulate a {@link TiledScene}. Its devices have been read once when it is new. */
interface BenchWorld {
    /**
     * So many intervals of simulated time, each of them commands by the newest readings, the physics steps, all
     * devices.
     */
    void advance(int intervals);

    /** The newest ones; the same object always. */
    Readings readings();
}
