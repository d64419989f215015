package io.troupe.petri.testkit;

import static java.util.Objects.requireNonNull;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.CallObserver;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.RingFinder;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringObserver;
import io.troupe.petri.wiring.WiringRecorder;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.extension.AfterEachCallback;
import org.junit.jupiter.api.extension.BeforeEachCallback;
import org.junit.jupiter.api.extension.ExtensionContext;

/**
 * A JUnit extension that follows the actors of each test, and fails a test whose actors wait for each other in a ring,
 * or leave their declaration. The message is the story.
 *
 * {@snippet :
 * @RegisterExtension
 * final FollowedActors actors = FollowedActors.forRings();
 *
 * @Test
 * void purchase_isPaid() {
 *     var test = actors.testSpace();
 *     Bank bank = test.spawn(Bank.class, SmallBank::new);
 *     Shop shop = test.spawn(Shop.class, () -> new CornerShop(bank));
 *     assertThat(test.get(shop.buy("lamp"))).isEqualTo("paid");
 * }
 * }
 *
 * <p>Actors are followed in the spaces of this extension, which the end of the test closes: {@link #testSpace}, and
 * {@link #space} for a space with a thread. Spaces that the test makes and closes itself are followed by
 * {@link #observer}; what is still open at their end is not judged, except that a ring has blocked. Nor is it in the
 * spaces of this extension as long as a timer is set in one of them, because something happens yet: advance the clock
 * until what the test has begun is done.
 *
 * <p><b>Role.</b> For tests whose class path has JUnit 5 and {@code troupe-actor-core}. What is found without a
 * declaration is described in {@link RingFinder}; how calls are compared with one, in {@link WiringObserver}.
 *
 * <p><b>Threads.</b> The test's thread; the spaces may have others.
 *
 * <p><b>Errors.</b> {@link AssertionError} for a ring that blocks or is possible, and
 * {@link WiringMonitor.ViolationException} for what is not declared. If the test has failed already, they are added to
 * its failure.
 */
public final class FollowedActors implements BeforeEachCallback, AfterEachCallback {
    private static final long IDLE_WITHIN_SECONDS = 60;
    private static final int MAX_ROUNDS = 1_000; // over all spaces, as each may call the others

    private final @Nullable Wiring wiring;
    private final WiringObserver.@Nullable Translation translation;
    private final @Nullable WiringRecorder recorder;
    private Followed now;

    /** What is followed in one test. */
    private static final class Followed {
        final RingFinder rings = new RingFinder();
        final Optional<WiringMonitor> monitor;
        final CallObserver observer;
        final AtomicLong events = new AtomicLong();
        final List<ActorSpace> spaces = new ArrayList<>();

        @Nullable
        TestSpace testSpace;

        Followed(Optional<WiringMonitor> monitor, Optional<CallObserver> declared) {
            this.monitor = monitor;
            var counter = new CallObserver() {
                @Override
                public void called(Party from, Party to, Call call) {
                    events.incrementAndGet();
                }
            };
            observer = declared.map(counter::and).orElse(counter).and(rings);
        }
    }

    private FollowedActors(
            @Nullable Wiring wiring,
            WiringObserver.@Nullable Translation translation,
            @Nullable WiringRecorder recorder) {
        this.wiring = wiring;
        this.translation = translation;
        this.recorder = recorder;
        this.now = begin();
    }

    /** Fails a test on a ring; nothing is declared. */
    public static FollowedActors forRings() {
        return new FollowedActors(null, null, null);
    }

    /** Fails a test also when an actor leaves the protocol of its component in this wiring. */
    public static FollowedActors through(Wiring wiring) {
        return new FollowedActors(requireNonNull(wiring, "wiring"), null, null);
    }

    /** Like {@link #through(Wiring)}, for calls that have other names in the wiring. */
    public static FollowedActors through(Wiring wiring, WiringObserver.Translation translation) {
        return new FollowedActors(requireNonNull(wiring, "wiring"), requireNonNull(translation, "translation"), null);
    }

    /** Fails a test on a ring, and adds each test to the runs of a recorder. */
    public static FollowedActors recordedBy(WiringRecorder recorder) {
        return new FollowedActors(null, null, requireNonNull(recorder, "recorder"));
    }

    private Followed begin() {
        if (recorder != null) {
            recorder.newRun();
            return new Followed(Optional.empty(), Optional.of(recorder));
        }
        var monitor = Optional.ofNullable(wiring)
                .map(declared -> WiringMonitor.of(declared).observing(WiringObserver.stepsFromOutside(declared)));
        return new Followed(
                monitor,
                monitor.map(each ->
                        translation == null ? new WiringObserver(each) : new WiringObserver(each, translation)));
    }

    /** The space of this test, without a thread; made by the first call. */
    public TestSpace testSpace() {
        if (now.testSpace == null) {
            now.testSpace = new TestSpace(now.observer);
        }
        return now.testSpace;
    }

    /**
     * Creates a space with these settings. At the end of the test it has to come to rest, and is closed; a test may
     * also close it before.
     */
    public ActorSpace space(SpaceSettings settings) {
        CallObserver other = settings.callObserver();
        var space =
                ActorSpace.create(settings.withCallObserver(other == null ? now.observer : now.observer.and(other)));
        now.spaces.add(space);
        return space;
    }

    /** For the settings of spaces that the test closes itself. */
    public CallObserver observer() {
        return now.observer;
    }

    /** The rings of this test so far. */
    public RingFinder rings() {
        return now.rings;
    }

    /** For events that no call is, and for what must never be. */
    public WiringMonitor monitor() {
        return now.monitor.orElseThrow(
                () -> new IllegalStateException("there is no wiring, expected FollowedActors.through(wiring)"));
    }

    /** For JUnit. */
    @Override
    public void beforeEach(ExtensionContext context) {
        now = begin();
    }

    /** For JUnit. */
    @Override
    public void afterEach(ExtensionContext context) {
        var failures = new ArrayList<Throwable>();
        attempt(failures, () -> {
            if (comesToRest() && !hasTimers()) {
                now.rings.idle();
                now.monitor.ifPresent(WiringMonitor::idle);
            }
        });
        attempt(failures, () -> now.monitor.ifPresent(WiringMonitor::end));
        var closing = new ArrayList<Throwable>(); // which also shows rings that were cut
        if (now.testSpace != null) {
            attempt(closing, now.testSpace::close);
        }
        now.spaces.forEach(space -> attempt(closing, space::close));
        attempt(failures, () -> now.monitor.ifPresent(WiringMonitor::check));
        attempt(failures, now.rings::check);
        failures.addAll(closing);
        if (!failures.isEmpty()) {
            if (failures.stream().anyMatch(InterruptedException.class::isInstance)) {
                Thread.currentThread().interrupt();
            }
            var first = failures.removeFirst();
            failures.forEach(first::addSuppressed);
            FollowedActors.<RuntimeException>rethrow(first);
        }
    }

    private interface Attempt {
        void run() throws InterruptedException;
    }

    private static void attempt(List<Throwable> failures, Attempt step) {
        try {
            step.run();
        } catch (Throwable failure) { // of a test: all of them are reported
            failures.add(failure);
        }
    }

    @SuppressWarnings("unchecked") // thrown as it is: it is an error or unchecked
    private static <E extends Throwable> void rethrow(Throwable failure) throws E {
        throw (E) failure;
    }

    /** Lets the spaces run until they have nothing to do. */
    private boolean comesToRest() throws InterruptedException {
        for (int round = 0; round < MAX_ROUNDS; round++) {
            long before = now.events.get();
            if (now.testSpace != null && isOpen(now.testSpace.space())) {
                now.testSpace.runQueued();
            }
            for (var space : now.spaces) {
                if (isOpen(space)) {
                    letRest(space);
                }
            }
            if (now.events.get() == before) {
                return true;
            }
        }
        throw new AssertionError("actors of " + allSpaces() + " still call each other after " + MAX_ROUNDS
                + " rounds, expected them to come to rest");
    }

    private static boolean isOpen(ActorSpace space) {
        return !space.whenClosed().toCompletableFuture().isDone();
    }

    private static void letRest(ActorSpace space) throws InterruptedException {
        var idle = new CountDownLatch(1);
        try {
            space.onIdle(idle::countDown);
        } catch (ActorStoppedException closed) {
            return; // by the test, or one of its actors
        }
        space.whenClosed().thenRun(idle::countDown);
        if (!idle.await(IDLE_WITHIN_SECONDS, TimeUnit.SECONDS)) {
            throw new AssertionError("space " + space + " still has something to do " + IDLE_WITHIN_SECONDS
                    + " s after the test, expected it to come to rest");
        }
    }

    private List<ActorSpace> allSpaces() {
        var all = new ArrayList<>(now.spaces);
        if (now.testSpace != null) {
            all.addFirst(now.testSpace.space());
        }
        return all;
    }

    /** Something happens yet when their time has come. */
    private boolean hasTimers() {
        return allSpaces().stream()
                .anyMatch(space -> isOpen(space) && space.metrics().timers() > 0);
    }
}
