package io.troupe.sim;

import io.troupe.actor.Clock;
import java.lang.System.Logger.Level;
import java.util.Objects;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Ticks a simulation on a separate thread while it has clients.
 *
 * <p><b>Role.</b> For programs that use only a Player client. Started for a simulation, which stays open when the
 * runner is closed.
 *
 * <p><b>Threads.</b> A daemon thread. No other thread may tick the simulation before or meanwhile.
 *
 * <p><b>Order.</b> Simulated time starts when the given number of clients have subscribed and wait for their first data
 * (by {@code runThreaded}, {@code readAll}, {@code isDataReady} or {@code nextData}), so all of them start at the same
 * time in every run. It stops while there is no client. By default it runs as fast as the clients answer, and in real
 * time while a client that never answers is connected; another {@link Pace} can be set.
 *
 * <p><b>Errors.</b> An exception or {@link Error} of a tick or of the observer ends the run, disconnects the clients
 * with the same message, closes the simulation, fails {@link #ended}, and is thrown by {@link #close}. An interrupt of
 * the runner's thread does the same.
 */
public final class SimulationRunner implements AutoCloseable {
    private final Simulation simulation;
    private final int clients;
    private final Consumer<Snapshot> observer;
    private final Thread thread;
    private final RealTimePacer pacer;
    private volatile Pace pace;
    private volatile boolean stopping;
    private volatile @Nullable RuntimeException failure;
    private final CompletableFuture<@Nullable Void> ended = new CompletableFuture<>();

    private SimulationRunner(Simulation simulation, int clients, Consumer<Snapshot> observer, Pace pace) {
        this.simulation = simulation;
        this.clients = clients;
        this.observer = observer;
        this.pace = pace;
        this.pacer = new RealTimePacer(Clock.system(), simulation::sleep);
        this.thread = Thread.ofPlatform()
                .name("simulation-" + simulation.world().spec().name())
                .daemon()
                .unstarted(this::run);
    }

    /**
     * Starts a runner.
     *
     * @param clients how many clients it waits for before the first tick
     * @param observer receives the snapshot after each tick, on the runner's thread
     */
    public static SimulationRunner start(Simulation simulation, int clients, Consumer<Snapshot> observer) {
        return start(simulation, clients, observer, new Pace.OfAnswers());
    }

    /** Starts a runner with the given pace. */
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

    /** Closes the simulation before it logs: after an {@link OutOfMemoryError}, for example, the log may fail too. */
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
     * Completes when the runner has stopped: exceptionally with the failure that ended the run, normally if it was
     * stopped or the simulation was closed.
     */
    public CompletionStage<@Nullable Void> ended() {
        return ended.minimalCompletionStage();
    }

    /** Changes the pace, from the next tick on. */
    public void pace(Pace newPace) {
        pace = Objects.requireNonNull(newPace, "newPace");
    }

    /** Simulated time that was dropped because it was more than a quarter of a second late. */
    public long droppedMicros() {
        return pacer.droppedMicros();
    }

    /** True while time stands still because there are too few clients. */
    public boolean isWaitingForClients() {
        return simulation.waitsForClients();
    }

    /** True while the runner's thread is alive. */
    public boolean isRunning() {
        return thread.isAlive();
    }

    /** Stops after the current tick, or while it waits, and throws the failure that ended the run, if any. */
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
