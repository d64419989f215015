package io.troupe.sim;

import io.troupe.actor.time.Clock;
import java.lang.System.Logger.Level;
import java.util.Objects;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Ticks a simulation as long as it has clients, on a thread of its own.
 *
 * <p><b>Role.</b> For programs that know of nothing but their Player client. Started for a simulation, which it leaves
 * open when it is closed.
 *
 * <p><b>Threads.</b> A daemon thread; nobody else may tick the simulation before or meanwhile.
 *
 * <p><b>Order.</b> Time stands still until the given number of clients have subscribed and wait for their first data
 * (by {@code runThreaded}, {@code readAll}, {@code isDataReady} or {@code nextData}): so all of them start at the same
 * moment in every run. It stands still again while there is no client. The pace is that of the answers; while a client
 * never answers it is that of real time, unless another {@link Pace} is asked for.
 *
 * <p><b>Errors.</b> Whatever a tick or the observer throws, an {@link Error} too, ends the run, disconnects the clients
 * with the same message, closes the simulation, fails {@link #ended}, and is thrown by {@link #close}; so does an
 * interrupt of the runner's thread.
 */
public final class SimulationRunner implements AutoCloseable {
    private final Simulation simulation;
    private final int clients;
    private final Consumer<Snapshot> observer;
    private final Thread thread;
    private final Pacer pacer;
    private volatile Pace pace;
    private volatile boolean stopping;
    private volatile @Nullable RuntimeException failure;
    private final CompletableFuture<@Nullable Void> ended = new CompletableFuture<>();

    private SimulationRunner(Simulation simulation, int clients, Consumer<Snapshot> observer, Pace pace) {
        this.simulation = simulation;
        this.clients = clients;
        this.observer = observer;
        this.pace = pace;
        this.pacer = new Pacer(Clock.system(), simulation::sleep);
        this.thread = Thread.ofPlatform()
                .name("simulation-" + simulation.world().spec().name())
                .daemon()
                .unstarted(this::run);
    }

    /**
     * Starts a runner.
     *
     * @param clients how many it waits for before the first tick
     * @param observer gets every snapshot that a tick leads to, on the runner's thread
     */
    public static SimulationRunner start(Simulation simulation, int clients, Consumer<Snapshot> observer) {
        return start(simulation, clients, observer, new Pace.OfAnswers());
    }

    /** The same at a pace of its own. */
    public static SimulationRunner start(Simulation simulation, int clients, Consumer<Snapshot> observer, Pace pace) {
        Objects.requireNonNull(pace, "pace");
        Objects.requireNonNull(observer, "observer");
        if (clients < 1) {
            throw new IllegalArgumentException("clients is " + clients + ", expected at least 1");
        }
        var runner = new SimulationRunner(simulation, clients, observer, pace);
        runner.thread.start();
        return runner;
    }

    private void run() {
        try {
            boolean open = simulation.awaitClients(clients);
            while (open && !stopping) {
                observer.accept(simulation.tick(pacer, pace));
                open = simulation.awaitClients(1);
            }
        } catch (InterruptedException interrupted) {
            if (!stopping) { // not by close()
                fail(new IllegalStateException("the thread that ticks the simulation was interrupted", interrupted));
            }
        } catch (RuntimeException thrown) {
            if (!stopping && !simulation.isClosed()) {
                fail(thrown);
            }
        } catch (Error thrown) {
            fail(new IllegalStateException(thrown.toString(), thrown));
        } finally {
            RuntimeException reason = failure;
            if (reason == null) {
                ended.complete(null);
            } else {
                ended.completeExceptionally(reason);
            }
        }
    }

    /** The clients first: the machine may be short of what the rest needs. */
    private void fail(RuntimeException reason) {
        failure = reason;
        try {
            simulation.close("the simulation has ended: " + reason.getMessage());
        } catch (RuntimeException | Error alsoThrown) { // a recording that cannot be written, for example
            if (alsoThrown != reason) {
                reason.addSuppressed(alsoThrown);
            }
        }
        System.getLogger(SimulationRunner.class.getName()).log(Level.ERROR, "the simulation has ended", reason);
    }

    /**
     * Completes when it ticks no more: as a failure by what ended the run, else when it was stopped or the simulation
     * closed.
     */
    public CompletionStage<@Nullable Void> ended() {
        return ended.minimalCompletionStage();
    }

    /** Changes the pace, from the next tick on. */
    public void pace(Pace newPace) {
        pace = Objects.requireNonNull(newPace, "newPace");
    }

    /**
     * How much simulated time is late for good, because it could not be caught up with within a quarter of a second.
     */
    public long droppedMicros() {
        return pacer.droppedMicros();
    }

    /** Whether it may still tick. */
    public boolean isRunning() {
        return thread.isAlive();
    }

    /**
     * Stops after the current tick, or in the middle of its waiting, and throws what ended the run if something did.
     */
    @Override
    public void close() {
        stopping = true;
        if (Thread.currentThread() != thread) {
            thread.interrupt();
            try {
                thread.join();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
        RuntimeException thrown = failure;
        if (thrown != null) {
            throw thrown;
        }
    }
}
