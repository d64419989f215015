package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Requests that have begun and are not answered when the instance that began them ends. */
class OpenRequestsTest extends InTestSpace {
    private final List<Deferred<String>> drivers = new ArrayList<>();

    class Desk extends Actor {
        public Promise<String> later(String what) {
            drivers.add(new Deferred<>());
            return drivers.getLast();
        }

        public Promise<String> laterInCapitals() {
            return later("").thenApply(String::toUpperCase);
        }

        public Promise<String> inABody() {
            return context().space().sequential(() -> later("").await());
        }

        public Promise<String> forward(Desk other) {
            return other.later("forwarded");
        }

        public Promise<Integer> work() {
            context().stop();
            return Promise.of(1);
        }

        public void fail() {
            throw new IllegalStateException("no paper");
        }

        public void end() {
            context().stop();
        }

        @Override
        protected void stopped() {
            log.add("stopped");
        }
    }

    private Desk spawn(String name, Supervision supervision) {
        var settings = ActorSettings.named(name).withSupervision(supervision).withOnError((where, error) -> {});
        return test.spawn(Desk.class, Desk::new, settings);
    }

    private static void assertBegun(@Nullable Throwable error, String request, String reason) {
        assertThat(error)
                .isInstanceOf(ActorStoppedException.class)
                .hasMessage(request + " was begun and not answered: " + reason);
        assertThat(((ActorStoppedException) error).mayHaveRun()).isTrue();
    }

    @Test
    void stop_rejectsRequestsThatHaveBegun_inTheOrderInWhichTheyBegan_beforeWatchersAreNotified() {
        Desk desk = spawn("desk", Supervision.RESUME);
        desk.later("a").handle((value, error) -> log.add("first"));
        desk.later("b").handle((value, error) -> log.add("second"));
        test.space().whenStopped(desk).thenRun(() -> log.add("watcher"));
        Promise<String> third = desk.laterInCapitals();
        Promise<String> body = desk.inABody();
        Promise<String> cancelled = desk.later("cancelled");
        test.runQueued();
        cancelled.cancel();
        desk.end();
        Promise<String> tooLate = desk.later("c");
        assertBegun(test.error(third), "Desk.laterInCapitals() of desk", "the actor desk has stopped");
        assertBegun(test.error(body), "Desk.inABody() of desk", "the actor desk has stopped");
        assertThat(cancelled.isCancelled()).isTrue();
        assertThat(log).containsExactly("stopped", "first", "second", "watcher");
        assertThat(((ActorStoppedException) test.error(tooLate)).mayHaveRun()).isFalse();
    }

    @Test
    void restart_rejectsRequestsThatHaveBegun_andNamesTheFailure() {
        Desk desk = spawn("desk", Supervision.restart(3, Duration.ofSeconds(1)));
        Promise<String> answer = desk.later("a");
        desk.fail();
        assertBegun(test.error(answer), "Desk.later(String) of desk", "the actor desk was restarted");
        assertThat(answer.error()).hasRootCauseMessage("no paper");
        Promise<String> ofTheFreshInstance = desk.later("b");
        test.runQueued();
        drivers.getLast().resolve("done");
        assertThat(test.get(ofTheFreshInstance)).isEqualTo("done");
    }

    @Test
    void resume_keepsRequestsThatHaveBegun() {
        Desk desk = spawn("desk", Supervision.RESUME);
        Promise<String> answer = desk.later("a");
        desk.fail();
        test.runQueued();
        drivers.getFirst().resolve("done");
        assertThat(test.get(answer)).isEqualTo("done");
    }

    @Test
    void stopByAFailure_isTheCause_ofWhatHadBegunAndOfWhatHadNot() {
        Desk desk = spawn("desk", Supervision.STOP);
        Promise<String> begun = desk.later("a");
        desk.fail();
        Promise<String> waiting = desk.later("b");
        assertThat(test.error(begun)).hasRootCauseMessage("no paper");
        assertThat(test.error(waiting)).hasRootCauseMessage("no paper");
    }

    @Test
    void factoryThatThrows_isTheCause() {
        var settings = ActorSettings.defaults().withOnError((where, error) -> {});
        Desk desk = test.space().spawn(Desk.class, OpenRequestsTest::noDesk, settings);
        assertThat(test.error(desk.later("a")))
                .isInstanceOf(ActorStoppedException.class)
                .hasRootCauseMessage("no desk");
    }

    private static Desk noDesk() {
        throw new IllegalStateException("no desk");
    }

    @Test
    void stopInTheTurnOfARequest_doesNotTouchItsAnswer() {
        Desk desk = spawn("desk", Supervision.RESUME);
        assertThat(test.get(desk.work())).isEqualTo(1);
    }

    @Test
    void requestThatWasForwarded_isTheOthersToAnswer() {
        Desk front = spawn("front", Supervision.RESUME);
        Desk back = spawn("back", Supervision.RESUME);
        Promise<String> answered = front.forward(back);
        Promise<String> abandoned = front.forward(back);
        test.runQueued();
        front.end();
        test.runQueued();
        assertThat(answered.isDone()).isFalse();
        drivers.getFirst().resolve("from the back");
        assertThat(test.get(answered)).isEqualTo("from the back");
        back.end();
        assertBegun(test.error(abandoned), "Desk.later(String) of back", "the actor back has stopped");
    }

    @Test
    void outcomeThatComesAfterTheEnd_isIgnored() {
        Desk desk = spawn("desk", Supervision.RESUME);
        Promise<String> answer = desk.later("a");
        desk.later("b").exceptionally(error -> "");
        test.runQueued();
        desk.end();
        Throwable error = test.error(answer);
        assertThat(drivers.get(0).resolve("too late")).isTrue();
        assertThat(drivers.get(1).reject(new IllegalStateException("too late"))).isTrue();
        test.runQueued();
        assertThat(answer.error()).isSameAs(error);
    }

    @Test
    void close_rejectsRequestsThatHaveBegun_andCountsThem() {
        var space = ActorSpace.create(SpaceSettings.named("short-lived")
                .withOnError((where, error) -> log.add(where))
                .withoutThread());
        Desk desk = space.spawn(Desk.class, Desk::new, ActorSettings.named("desk"));
        Promise<String> asked = desk.later("a");
        Promise<String> answered = desk.later("b");
        Promise<String> cancelled = desk.later("c");
        space.runQueued();
        drivers.get(1).resolve("in time");
        cancelled.cancel();
        Leftovers left = space.close(Duration.ofSeconds(1));
        assertBegun(asked.error(), "Desk.later(String) of desk", "space short-lived is closed");
        assertThat(answered.getNow()).isEqualTo("in time");
        assertThat(left).isEqualTo(new Leftovers(0, 0, 1, 0, 0, 0, List.of("Desk.later(String) of desk")));
        assertThat(left.isEmpty()).isFalse();
        assertThat(left.toString()).contains("0 requests, 1 open requests");
        assertThat(log).as("no problem").containsExactly("stopped");
    }

    @Test
    @Timeout(60)
    void stop_onAThreadOfItsOwn_endsTheWaitOfTheCaller() throws Exception {
        Deferred<String> begun = Deferred.unbound();
        try (var space = ActorSpace.create(SpaceSettings.named("short-lived"))) {
            Desk desk = space.spawn(Desk.class, Desk::new, ActorSettings.named("desk"));
            Promise<String> answer = desk.later("a");
            desk.work().thenAccept(one -> begun.resolve("stopped"));
            assertThat(begun.get(Duration.ofSeconds(60))).isEqualTo("stopped");
            Throwable error = answer.handle((value, rejection) -> rejection).get(Duration.ofSeconds(60));
            assertBegun(error, "Desk.later(String) of desk", "the actor desk has stopped");
        }
    }

    /** As those of a queue of jobs, which looks before it begins the next one. */
    @Test
    void answer_isAbandoned_whenItsCallersHaveCancelled_orTimedOut_orHadACommonLimit() {
        Desk desk = spawn("desk", Supervision.RESUME);
        var limit = Duration.ofMillis(20);
        Promise<String> cancelled = desk.later("one");
        Promise<String> timedOut = desk.later("two").orTimeout(limit).exceptionally(overdue -> "too late");
        Promise<String> together =
                test.space().within(limit, () -> desk.later("three")).exceptionally(overdue -> "too late");
        Promise<String> twoCallers = desk.later("four");
        twoCallers.orTimeout(limit).exceptionally(overdue -> "too late");
        twoCallers.then(value -> {});
        desk.later("five").then(value -> {});
        test.runQueued();
        assertThat(drivers).hasSize(5).noneMatch(Deferred::isAbandoned);
        cancelled.cancel();
        test.advance(limit);
        assertThat(drivers).extracting(Deferred::isAbandoned).containsExactly(true, true, true, false, false);
        assertThat(test.get(timedOut) + ", " + test.get(together)).isEqualTo("too late, too late");
        drivers.forEach(each -> each.resolve("done"));
        assertThat(drivers).as("settled").allMatch(Deferred::isAbandoned);
        test.runQueued();
        assertThat(twoCallers.getNow()).isEqualTo("done");
    }

    /** A registry of proxies, as a broker keeps it, keeps nothing else. */
    @Test
    void factoryOfAnActorThatHasStopped_isNotKept() {
        var large = new Object();
        var kept = new WeakReference<>(large);
        Desk desk = test.spawn(Desk.class, factoryWith(large));
        test.runQueued();
        large = null;
        stop(desk);
        for (int attempt = 0; attempt < 50 && kept.get() != null; attempt++) {
            System.gc();
        }
        assertThat(kept.get()).isNull();
        assertThat(desk.toString()).contains("Desk");
    }

    private Supplier<Desk> factoryWith(Object part) {
        return () -> {
            assertThat(part).isNotNull();
            return new Desk();
        };
    }

    @Test
    void requestsThatWereSettledOrCancelled_areNotKept() {
        Desk desk = spawn("desk", Supervision.RESUME);
        var settled = new WeakReference<>(desk.later("settled"));
        test.runQueued();
        drivers.removeFirst().resolve("done");
        var cancelled = new ArrayList<WeakReference<Promise<String>>>();
        for (int index = 0; index < 100; index++) {
            Promise<String> answer = desk.later("cancelled");
            cancelled.add(new WeakReference<>(answer));
            test.runQueued();
            answer.cancel();
        }
        test.runQueued();
        drivers.clear(); // the actor no longer refers to them: only the list of open requests could retain them
        System.gc();
        assertThat(settled.get()).isNull();
        assertThat(cancelled).filteredOn(each -> each.get() != null).hasSizeLessThan(20);
    }
}
