package io.troupe.actor.guide;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorEnd;
import io.troupe.actor.ActorException;
import io.troupe.actor.ActorPool;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.ActorTypeException;
import io.troupe.actor.CallGraph;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Callback;
import io.troupe.actor.Clock;
import io.troupe.actor.DeadLetter;
import io.troupe.actor.Deferred;
import io.troupe.actor.ErrorHandler;
import io.troupe.actor.InTestSpace;
import io.troupe.actor.Leftovers;
import io.troupe.actor.MailboxFullException;
import io.troupe.actor.ManualClock;
import io.troupe.actor.Outcome;
import io.troupe.actor.Promise;
import io.troupe.actor.Schedule;
import io.troupe.actor.SpaceMetrics;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.Stall;
import io.troupe.actor.Supervision;
import io.troupe.actor.Timer;
import io.troupe.actor.Topic;
import io.troupe.actor.TurnContext;
import io.troupe.actor.Unanswered;
import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.Probe;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.Flow;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The samples in the Javadoc of actor-core, with assertions for their comments; {@code SamplesTest} compares the texts.
 */
class JavadocSamplesTest extends InTestSpace {
    private final ActorSpace space = test.space();

    interface Greeter {
        Promise<String> greet(String name);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void actorSpace_spawnsAnActor_thatAnswers() {
        try (ActorSpace space = ActorSpace.create(SpaceSettings.named("hello"))) {
            Greeter greeter = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
            greeter.greet("Ada").then(text -> log.add(text)); // on the thread of the space
        } // close() serves what was queued
        assertThat(log).containsExactly("Hello, Ada");
    }

    private static final class Polite implements Greeter {
        @Override
        public Promise<String> greet(String name) {
            return Promise.of("Hello, " + name);
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void actorPool_choosesAnActorForEachCall() throws Exception {
        try (ActorPool<Greeter> pool =
                ActorPool.create(2, SpaceSettings.named("greeter"), Greeter.class, Polite::new)) {
            Greeter next = pool.roundRobin(); // each call goes to the next actor
            Greeter same = pool.byFirstArgument(); // calls for one name go to one actor
            log.add(next.greet("Ada").get(Duration.ofSeconds(10)));
            log.add(same.greet("Ada").get(Duration.ofSeconds(10)));
        } // closes the spaces
        assertThat(log).containsExactly("Hello, Ada", "Hello, Ada");
    }

    static class Heater extends Actor {
        private int degrees = 18;

        @Override
        protected void started() {
            context().every(Duration.ofMinutes(1), () -> degrees++);
        }

        public void set(int newDegrees) {
            degrees = newDegrees;
        }

        public Promise<Integer> degrees() {
            return Promise.of(degrees);
        }
    }

    @Test
    void actor_isTheTypeThatOthersCall() {
        Heater heater = space.spawn(Heater.class, Heater::new); // a proxy
        heater.set(20); // a message
        test.advance(Duration.ofMinutes(3));
        assertThat(test.get(heater.degrees())).isEqualTo(23);
    }

    interface Motor {
        void turn(double speedRadps);

        void stop();
    }

    private class GearMotor extends Actor implements Motor {
        private double speedRadps;

        @Override
        public void turn(double newSpeedRadps) {
            speedRadps = newSpeedRadps;
            context().after("silence", Duration.ofSeconds(3), this::stop); // unless the next command comes first
        }

        @Override
        public void stop() {
            speedRadps = 0;
            context().cancelTimer("silence");
        }
    }

    @Test
    void actorContext_leavesItsNamesToMessages() {
        Motor motor = space.spawn(Motor.class, () -> new GearMotor() {
            @Override
            public void stop() {
                log.add("stop at " + ((GearMotor) this).speedRadps);
                super.stop();
            }
        });
        motor.turn(1.5);
        test.advance(Duration.ofSeconds(2));
        motor.turn(2.5);
        test.advance(Duration.ofSeconds(2));
        assertThat(log).isEmpty();
        test.advance(Duration.ofSeconds(1));
        motor.stop();
        test.runQueued();
        assertThat(log).containsExactly("stop at 2.5", "stop at 0.0");
    }

    @Test
    void actorSpace_ofAnActor_stopsIt() {
        Greeter greeter = space.spawn(Greeter.class, Polite::new);
        Promise<ActorEnd> end = space.whenStopped(greeter);
        ActorSpace.of(greeter).stop(greeter); // whichever of the spaces it is in
        assertThat(test.get(end)).isEqualTo(new ActorEnd.Stopped());
    }

    interface Modem {
        Promise<String> connect();
    }

    static class Caller extends Actor {
        private final Modem modem;
        private String connected = "";

        Caller(Modem modem) {
            this.modem = modem;
        }

        @Override
        protected void started() {
            context().hold();
            modem.connect().then(line -> {
                connected = line;
                context().release(); // now the calls that came meanwhile are served, in their order
            });
        }

        public Promise<String> line() {
            return Promise.of(connected);
        }
    }

    @Test
    void actor_holdsItsCallsBack_untilItIsConnected() {
        Probe<Modem> modem = test.probe(Modem.class);
        Caller caller = space.spawn(Caller.class, () -> new Caller(modem.actor()));
        Promise<String> line = caller.line();
        modem.answer("line 7");
        assertThat(test.get(line)).isEqualTo("line 7");
    }

    static class Counter extends Actor {
        private int count;

        public void add(int amount) {
            if (amount < 0) {
                throw new IllegalArgumentException("amount is " + amount);
            }
            count += amount;
        }

        public Promise<Integer> count() {
            return Promise.of(count);
        }
    }

    @Test
    void actorSettings_nameBoundAndSuperviseAnActor() {
        ActorSettings settings = ActorSettings.named("counter")
                .withSupervision(Supervision.restart(3, Duration.ofMinutes(1)))
                .withMailbox(1_000, Overflow.REJECT);
        Counter counter = space.spawn(Counter.class, Counter::new, settings);
        assertThat(counter).hasToString("counter");
        counter.add(5);
        counter.add(-1);
        assertThat(test.get(counter.count())).isZero(); // a new instance
        assertThat(test.takeProblems())
                .extracting(TestSpace.Problem::where)
                .containsExactly("Counter.add(int) of counter");
    }

    @Test
    void callObserver_observesCalls() {
        List<String> seen = new CopyOnWriteArrayList<>();
        var observer = new CallObserver() {
            @Override
            public void called(Party from, Party to, Call call) {
                seen.add(from.name() + " calls " + to.name() + "." + call.method());
            }
        };
        ActorSpace space = ActorSpace.create(SpaceSettings.named("shop").withCallObserver(observer));
        space.spawn(Counter.class, Counter::new).add(5);
        space.close();
        assertThat(seen).containsExactly("outside calls Counter.add");
    }

    @Test
    void callGraph_countsWhoCallsWhom() {
        var graph = new CallGraph();
        ActorSpace space = ActorSpace.create(SpaceSettings.named("shop").withCallObserver(graph));
        Counter counter = space.spawn(Counter.class, Counter::new);
        counter.add(5);
        for (CallGraph.Edge edge : graph.snapshot().edges()) {
            log.add(edge.from().name() + " -> " + edge.to().name() + ": " + edge.calls());
        }
        space.close();
        assertThat(log).containsExactly("outside -> Counter: 1");
    }

    @Test
    void supervision_restartsTwice_thenStops() {
        ActorSettings settings =
                ActorSettings.defaults().withSupervision(Supervision.restart(2, Duration.ofSeconds(10)));
        Counter counter = space.spawn(Counter.class, Counter::new, settings);
        counter.add(-1); // restarts
        counter.add(-1); // restarts
        counter.add(-1); // the third failure within ten seconds: the actor stops
        assertThat(test.error(counter.count())).isInstanceOf(ActorStoppedException.class);
        assertThat(test.takeProblems()).hasSize(3);
    }

    @Test
    void supervision_dependsOnTheError_andPauses() {
        Supervision reconnecting = Supervision.restart(Duration.ofMinutes(1))
                .withPauses(Duration.ofMillis(100), Duration.ofSeconds(30)) // 100 ms, 200 ms, 400 ms and so on
                .on(IllegalArgumentException.class, Supervision.RESUME)
                .on(LinkageError.class, Supervision.STOP);
        var settings = ActorSettings.defaults().withSupervision(reconnecting);
        Counter counter = space.spawn(Counter.class, Counter::new, settings);
        counter.add(5);
        counter.add(-1);
        assertThat(test.get(counter.count())).isEqualTo(5);
        test.takeProblems();
    }

    @Test
    void actorEnd_saysWhyAnActorHasEnded() {
        var settings = ActorSettings.defaults().withSupervision(Supervision.STOP);
        Counter counter = space.spawn(Counter.class, Counter::new, settings);
        space.whenStopped(counter).then(end -> {
            switch (end) {
                case ActorEnd.Stopped stopped -> log.add("stopped");
                case ActorEnd.Failed failed ->
                    log.add("failed: " + failed.error().getMessage());
            }
        });
        counter.add(-1);
        test.runQueued();
        assertThat(log).containsExactly("failed: amount is -1");
        test.takeProblems();
    }

    interface Printer {
        void print(String page);
    }

    @Test
    void settings_areCopiedWithAChange() {
        ActorSettings settings = ActorSettings.named("counter").withMailbox(1_000, Overflow.REJECT);
        ActorSettings unlimited = settings.withoutMailboxLimit();
        assertThat(settings.mailboxCapacity()).isEqualTo(1_000);
        assertThat(unlimited.mailboxCapacity()).isNull();
        assertThat(unlimited.name()).isEqualTo("counter");
    }

    @Test
    void actorSettings_withOneCall_dropTheOldest() {
        ActorSettings newestOnly = ActorSettings.named("printer").withMailbox(1, Overflow.DROP_OLDEST);
        Printer printer = space.spawn(Printer.class, () -> log::add, newestOnly);
        printer.print("first");
        printer.print("second"); // takes the place of the first, which becomes a dead letter
        test.runQueued();
        assertThat(log).containsExactly("second");
        assertThat(test.takeDeadLetters()).extracting(DeadLetter::arguments).containsExactly(List.of("first"));
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void spaceSettings_defineWhereReportsGo() throws Exception {
        var reported = new Deferred<String>();
        var undelivered = new Deferred<DeadLetter>();
        ErrorHandler onError = (where, error) -> reported.resolve(where + ": " + error.getMessage());
        Consumer<DeadLetter> onDeadLetter = undelivered::resolve;
        Consumer<Stall> onStall = stall -> log.add(stall.toString());
        SpaceSettings settings = SpaceSettings.named("shop")
                .withOnError(onError)
                .withOnDeadLetter(onDeadLetter)
                .withOnStall(Duration.ofSeconds(30), onStall);
        ActorSpace space = ActorSpace.create(settings);
        Counter counter = space.spawn(Counter.class, Counter::new);
        counter.add(-1);
        assertThat(reported.get(LONG)).startsWith("Counter.add(int) of Counter#1: amount is -1");
        space.close();
        counter.add(1);
        assertThat(undelivered.get(LONG).message()).isEqualTo("Counter.add(int)");
    }

    @Test
    void errorHandler_isAFunction() {
        ErrorHandler handler = (where, error) -> log.add(where + " failed: " + error.getMessage());
        SpaceSettings settings = SpaceSettings.named("shop").withOnError(handler);
        settings.onError().handle("here", new IllegalStateException("why"));
        assertThat(log).containsExactly("here failed: why");
    }

    private static final ThreadLocal<String> USER = ThreadLocal.withInitial(() -> "nobody");

    @Test
    void turnContext_carriesTheUserOfACaller() {
        TurnContext<String> user = new TurnContext<>() {
            @Override
            public String capture() {
                return USER.get();
            }

            @Override
            public Runnable restore(String captured) {
                USER.set(captured);
                return USER::remove;
            }
        };
        USER.set("ann");
        try {
            var captured = user.capture();
            USER.remove();
            Runnable end = user.restore(captured);
            log.add(USER.get());
            end.run();
            log.add(USER.get());
        } finally {
            USER.remove();
        }
        assertThat(log).containsExactly("ann", "nobody");
    }

    @Test
    void deadLetter_namesItsActor_andTheReason() {
        Consumer<DeadLetter> onDeadLetter = letter -> log.add(letter.message() + " to " + letter.actor());
        ActorSpace space = ActorSpace.create(
                SpaceSettings.named("shop").withOnDeadLetter(onDeadLetter).withoutThread());
        Counter counter = space.spawn(Counter.class, Counter::new);
        space.close();
        counter.add(1); // too late
        assertThat(log).containsExactly("Counter.add(int) to Counter#1");
    }

    @Test
    void stall_namesItsSpace_andHowLong() {
        Consumer<Stall> onStall = stall -> log.add(stall.space() + ": " + stall.atLeast());
        SpaceSettings settings = SpaceSettings.named("shop").withOnStall(Duration.ofMillis(200), onStall);
        settings.onStall().accept(new Stall("shop", Duration.ofMillis(250), List.of()));
        assertThat(log).containsExactly("shop: PT0.25S");
    }

    @Test
    void leftovers_countWhatAClosedSpaceHadNotDone() {
        ActorSpace space = ActorSpace.create(SpaceSettings.named("shop").withoutThread());
        space.spawn(Heater.class, Heater::new);
        space.runQueued();
        Leftovers left = space.close(Duration.ofSeconds(5));
        if (!left.isEmpty()) {
            System.getLogger("shop").log(System.Logger.Level.WARNING, "not done: " + left);
        }
        assertThat(left.isEmpty()).isTrue(); // timers alone do not count as work that was not done
    }

    @Test
    void metrics_areReadFromAnyThread() {
        space.spawn(Heater.class, Heater::new);
        SpaceMetrics metrics = space.metrics();
        String line = metrics.actors() + " actors, " + metrics.waiting() + " waiting, behind by " + metrics.latency();
        assertThat(line).startsWith("0 actors, 1 waiting");
        test.runQueued();
        assertThat(metrics.actors()).isOne();
    }

    interface Camera {
        void watch(Callback<Integer> colours);
    }

    @Test
    void callback_bringsManyResults_andItsEnd_toALambda_aStream_orAProbe() {
        Camera camera = space.spawn(Camera.class, () -> seen -> {
            seen.next(0xFF0000);
            seen.next(0x00FF00);
            seen.finish();
        });
        var stream = new Callback.Stream<Integer>(colour -> log.add("got " + colour), end -> log.add("end " + end));
        camera.watch(stream); // stream.cancel() ends it
        camera.watch((colour, error) -> log.add("saw " + colour));
        CallbackProbe<Integer> colours = test.callback();
        camera.watch(colours);
        assertThat(colours.results()).containsExactly(0xFF0000, 0x00FF00);
        colours.expectFinished();
        assertThat(log).containsExactly("got 16711680", "got 65280", "end null", "saw 16711680", "saw 65280");
    }

    @Test
    void topic_bringsValuesToSubscribers() {
        Topic<Integer> colours = Topic.latest(space, "colours");
        colours.publish(0xFF0000);
        Callback.Stream<Integer> subscription = colours.subscribe(colour -> log.add("saw " + colour));
        colours.publish(0x00FF00); // returns 1: the number of subscribers
        test.runQueued();
        assertThat(log).containsExactly("saw 16711680", "saw 65280");
        subscription.cancel();
        assertThat(colours.publish(1)).isZero();
    }

    @Test
    void capacityOfOne_keepsTheNewest() {
        Topic<Integer> colours = Topic.of(space, "colours");
        Callback.Stream<Integer> newest = colours.subscribe(1, colour -> log.add("saw " + colour));
        colours.publish(0xFF0000);
        colours.publish(0x00FF00); // replaces the first, unless that was received meanwhile
        long lost = newest.dropped();
        assertThat(lost).isOne();
        test.runQueued();
        assertThat(log).containsExactly("saw 65280");
    }

    @Test
    void publisher_isForOtherLibraries() {
        Topic<Integer> colours = Topic.of(space, "colours");
        Camera camera = space.spawn(Camera.class, () -> seen -> seen.fail(new IllegalStateException("dark")));
        Flow.Publisher<Integer> publisher = space.publisher(16, colours::subscribe); // of a topic
        Flow.Publisher<Integer> watched = space.publisher(camera::watch); // of an actor
        for (var each : List.of(publisher, watched)) {
            each.subscribe(new Flow.Subscriber<>() {
                @Override
                public void onSubscribe(Flow.Subscription subscription) {
                    subscription.request(1);
                }

                @Override
                public void onNext(Integer colour) {
                    log.add("saw " + colour);
                }

                @Override
                public void onError(Throwable error) {
                    log.add(error.getMessage());
                }

                @Override
                public void onComplete() {}
            });
        }
        test.runQueued();
        colours.publish(1);
        test.runQueued();
        assertThat(log).containsExactly("dark", "saw 1");
    }

    interface Shop {
        Promise<Integer> price(String item);

        Promise<String> buy(String item, int price);
    }

    @Test
    void actorSpace_asksWithALimit() {
        Probe<Shop> probe = test.probe(Shop.class);
        Shop shop = probe.actor();
        ActorSpace space = test.space();
        Promise<String> receipt = space.within(Duration.ofSeconds(2), () -> shop.buy("lamp", 20));
        probe.expectCall("buy(lamp, 20)");
        test.advance(Duration.ofSeconds(2));
        assertThat(test.error(receipt)).hasMessageContaining("within PT2S");
        probe.takeUnanswered();
    }

    @Test
    void promise_isChained() {
        Probe<Shop> probe = test.probe(Shop.class);
        Shop shop = probe.actor();
        Promise<String> receipt = shop.price("lamp")
                .thenCompose(price -> shop.buy("lamp", price))
                .orTimeout(Duration.ofSeconds(2))
                .exceptionally(error -> "not bought: " + error.getMessage());
        receipt.then(text -> log.add(text));
        probe.answer(20);
        probe.expectCall("price(lamp)");
        probe.expectCall("buy(lamp, 20)");
        probe.answer("receipt no 7");
        assertThat(log).containsExactly("receipt no 7");
    }

    static class Turnstile extends Actor {
        private @Nullable Deferred<Boolean> coin;

        public Promise<Boolean> waitForCoin() {
            coin = new Deferred<>();
            return coin; // answered later
        }

        public void insertCoin() {
            if (coin != null) {
                coin.resolve(true);
            }
        }
    }

    @Test
    void deferred_isSettledLater() {
        Turnstile turnstile = test.spawn(Turnstile.class, Turnstile::new);
        Promise<Boolean> open = turnstile.waitForCoin();
        test.runQueued();
        assertThat(open.isDone()).isFalse();
        turnstile.insertCoin();
        assertThat(test.get(open)).isTrue();
    }

    @Test
    void outcomes_areMatchedByType() {
        Promise<String> first = Promise.of("lamp");
        Promise<String> second = Promise.failed(new IllegalStateException("sold out"));
        Promise.allSettled(List.of(first, second)).then(outcomes -> {
            for (Outcome<String> outcome : outcomes) {
                log.add(
                        switch (outcome) {
                            case Outcome.Fulfilled<String>(var value) -> value;
                            case Outcome.Rejected<String>(var error) -> error.getMessage();
                        });
            }
        });
        test.runQueued();
        assertThat(log).containsExactly("lamp", "sold out");
    }

    @Test
    void testSpace_movesTheClockByHand() {
        try (var test = new TestSpace()) {
            Heater heater = test.spawn(Heater.class, Heater::new);
            test.advance(Duration.ofMinutes(2));
            assertThat(test.get(heater.degrees())).isEqualTo(20);
        } // close() fails the test if an error or a message was forgotten
    }

    static class Clerk extends Actor {
        private final Shop shop;

        Clerk(Shop shop) {
            this.shop = shop;
        }

        public Promise<String> advise(String item) {
            return shop.price(item).thenApply(price -> price > 10 ? "wait" : "buy");
        }
    }

    @Test
    void probe_standsInForAnActor() {
        Probe<Shop> shop = test.probe(Shop.class);
        Clerk clerk = test.spawn(Clerk.class, () -> new Clerk(shop.actor()));
        Promise<String> advice = clerk.advise("lamp");
        shop.expectCall("price(lamp)");
        shop.answer(20);
        assertThat(test.get(advice)).isEqualTo("wait");
    }

    @Test
    void manualClock_isTheClockOfASpace() {
        ManualClock clock = new ManualClock();
        ActorSpace space = ActorSpace.create(
                SpaceSettings.named("simulation").withClock(clock).withoutThread());
        Promise<String> late =
                space.<String>deferred().orTimeout(Duration.ofSeconds(2)).exceptionally(error -> "too late");
        space.runQueued();
        clock.advance(Duration.ofSeconds(2));
        space.runQueued(); // serves the timers that are due
        assertThat(late.getNow()).isEqualTo("too late");
        space.close();
    }

    private class Controller extends Actor {
        private @Nullable Timer cycle;

        @Override
        protected void started() {
            cycle = context().every(Duration.ofMillis(100), Schedule.SKIP_MISSED, () -> log.add("cycle"));
        }

        public void pause() {
            if (cycle != null) {
                cycle.cancel();
            }
        }
    }

    @Test
    void schedule_andTimer_ofAControlLoop() {
        Controller controller = test.spawn(Controller.class, Controller::new);
        test.advance(Duration.ofMillis(250));
        controller.pause();
        test.advance(Duration.ofMillis(250));
        assertThat(log).containsExactly("cycle", "cycle");
    }

    @Test
    void listenerAtTheEndOfAChain_isNotifiedOfTheErrorToo() {
        Greeter greeter = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
        greeter.greet("Ada").onSettled((answer, error) -> log.add(error == null ? answer : "nobody is there"));
        test.runQueued();
        space.stop(greeter);
        greeter.greet("Ada").thenAccept(log::add).onRejected(error -> log.add("nobody is there"));
        test.runQueued();
        assertThat(log).containsExactly("Hello, Ada", "nobody is there");
    }

    @Test
    void actorException_isTheErrorOfACallWithoutAnActor() {
        Greeter greeter = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
        space.stop(greeter);
        Promise<String> answer = greeter.greet("Ada")
                .exceptionally(error -> error instanceof ActorException ? "the greeter is gone" : "the greeter failed");
        assertThat(test.get(answer)).isEqualTo("the greeter is gone");
    }

    @Test
    void actorStoppedException_isTheErrorOfARequestThatWasNotAnswered() {
        Greeter greeter = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
        space.stop(greeter);
        Promise<String> answer =
                greeter.greet("Ada").exceptionally(error -> error instanceof ActorStoppedException ? "gone" : "failed");
        assertThat(test.get(answer)).isEqualTo("gone");
    }

    @Test
    void unanswered_saysWhetherTheRequestMayHaveRun() {
        Greeter first = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
        Greeter second = space.spawn(Greeter.class, () -> name -> Promise.of("Good morning, " + name));
        space.stop(first);
        Promise<String> answer = first.greet("Ada")
                .exceptionallyCompose(error -> error instanceof Unanswered lost && !lost.mayHaveRun()
                        ? second.greet("Ada")
                        : Promise.failed(error));
        assertThat(test.get(answer)).isEqualTo("Good morning, Ada");
    }

    @Test
    void mailboxFullException_isTheErrorOfARequestWithoutRoom() {
        ActorSettings one = ActorSettings.named("greeter").withMailbox(1, Overflow.REJECT);
        Greeter greeter = test.space().spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name), one);
        greeter.greet("Ada");
        Promise<String> answer =
                greeter.greet("Bob").exceptionally(error -> error instanceof MailboxFullException ? "later" : "never");
        assertThat(test.get(answer)).isEqualTo("later");
    }

    interface Greeting {
        String greet(String name); // returns neither void nor a promise
    }

    @Test
    void actorTypeException_namesTheMethod() {
        assertThatThrownBy(() -> {
                    space.spawn(Greeting.class, () -> name -> "Hello, " + name); // throws
                })
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("Greeting.greet(String)");
    }

    @Test
    void clock_isThatOfTheTimers() {
        Clock clock = space.clock();
        long startNanos = clock.nanos();
        space.delay(Duration.ofSeconds(2))
                .thenRun(() -> log.add("after " + Duration.ofNanos(clock.nanos() - startNanos)));
        test.advance(Duration.ofSeconds(2));
        assertThat(log).containsExactly("after PT2S");
    }
}
