package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** An actor has one context, and the names of what it can do are free for messages. */
class ActorContextTest extends InTestSpace {
    private static final Duration SECOND = Duration.ofSeconds(1);

    interface Motor {
        void stop();

        void hold();

        void release();

        Promise<String> after(Duration delay, Runnable task);

        Promise<String> every(Duration period, Runnable task);

        void cancelTimer(Object key);

        Promise<Boolean> isTimerActive(Object key);

        Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Runnable body);

        Promise<String> space();

        void started(int times);
    }

    private class GearMotor extends Actor implements Motor {
        private int rounds;

        @Override
        protected void started() {
            context().every("beat", SECOND, () -> log.add("beat"));
        }

        @Override
        protected void stopped() {
            log.add("the end");
        }

        @Override
        public void stop() {
            log.add("stop");
            context().stop();
        }

        @Override
        public void hold() {
            log.add("hold");
            context().hold();
            context().after(SECOND.plusMillis(1), this::release);
        }

        @Override
        public void release() {
            log.add("release");
            context().release();
        }

        @Override
        public Promise<String> after(Duration delay, Runnable task) {
            Deferred<String> answer = context().space().deferred();
            context().after(delay, () -> {
                task.run();
                answer.resolve("after " + delay);
            });
            return answer;
        }

        @Override
        public Promise<String> every(Duration period, Runnable task) {
            context().every("every", period, task);
            return Promise.of("every " + period);
        }

        @Override
        public void cancelTimer(Object key) {
            log.add("cancelled " + context().cancelTimer(key));
        }

        @Override
        public Promise<Boolean> isTimerActive(Object key) {
            return Promise.of(context().isTimerActive(key));
        }

        @Override
        public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Runnable body) {
            return context().repeatWhile(() -> condition.getAsBoolean() && rounds < 2, () -> {
                rounds++;
                body.run();
            });
        }

        @Override
        public Promise<String> space() {
            return Promise.of("in " + context().space());
        }

        @Override
        public void started(int times) {
            log.add("started " + times);
        }
    }

    @Test
    void namesOfTheContext_areMessages_andTheContextWorksBesideThem() {
        Motor motor = test.spawn(Motor.class, GearMotor::new);
        assertThat(values(motor.space(), motor.repeatWhile(() -> true, () -> log.add("round"))))
                .containsExactly("in test-space", null);
        Promise<String> later = motor.after(SECOND, () -> log.add("task"));
        test.advance(SECOND);
        assertThat(values(later, motor.every(SECOND, () -> log.add("again")), motor.isTimerActive("every")))
                .containsExactly("after PT1S", "every PT1S", true);
        test.advance(SECOND);
        motor.cancelTimer("every");
        assertThat(values(motor.isTimerActive("every"))).containsExactly(false);
        assertThat(log).containsExactly("round", "round", "beat", "task", "beat", "again", "cancelled true");
        log.clear();
        motor.hold();
        motor.started(2);
        test.runQueued();
        assertThat(log).containsExactly("hold");
        test.advance(SECOND);
        test.advance(SECOND);
        motor.release();
        motor.stop();
        test.runQueued();
        test.advance(SECOND);
        assertThat(log).containsExactly("hold", "beat", "release", "started 2", "beat", "release", "stop", "the end");
    }

    @Test
    void context_isOneObjectPerActor_andIsThereFromStartedOn() {
        var contexts = new ArrayList<ActorContext>();
        Doer doer = test.spawn(Doer.class, () -> new Doer() {
            @Override
            protected void started() {
                contexts.add(context());
            }
        });
        doer.run(me -> contexts.add(me.context()));
        test.spawn(Doer.class, Doer::new).run(me -> contexts.add(me.context()));
        test.runQueued();
        assertThat(contexts).hasSize(3);
        assertThat(contexts.get(1)).isSameAs(contexts.get(0)).isNotSameAs(contexts.get(2));
        assertThatThrownBy(() -> new Doer().context())
                .isInstanceOf(IllegalStateException.class)
                .hasMessageStartingWith("context() of io.troupe.actor.Doer is for a spawned actor itself");
        assertThatThrownBy(doer::context)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("not through its proxy");
    }

    private ActorContext contextOf(Doer doer) {
        var contexts = new ArrayList<ActorContext>();
        doer.run(me -> contexts.add(me.context()));
        test.runQueued();
        return contexts.getFirst();
    }

    private void inSpace(Runnable task) {
        test.space().execute(task);
        test.runQueued();
    }

    private void assertEnded(ActorContext kept) {
        List<Timer> timers = new ArrayList<>();
        inSpace(() -> {
            timers.add(kept.after(SECOND, () -> log.add("late")));
            timers.add(kept.every(SECOND, () -> log.add("late")));
            timers.add(kept.after("key", SECOND, () -> log.add("late")));
            timers.add(kept.every("other key", SECOND, () -> log.add("late")));
            log.add(kept.isTimerActive("key") + " " + kept.cancelTimer("key"));
            kept.release();
            kept.hold();
            kept.stop();
            log.add("in " + kept.space());
        });
        assertThat(timers).hasSize(4).noneMatch(Timer::isWaiting);
        assertThat(test.space().isQuiet()).as("no timer is left").isTrue();
        test.advance(SECOND);
        assertThat(log).containsExactly("false false", "in test-space");
    }

    @Test
    void contextOfAStoppedActor_hasNoEffect() {
        Doer doer = test.spawn(Doer.class, Doer::new);
        ActorContext kept = contextOf(doer);
        stop(doer);
        assertEnded(kept);
    }

    @Test
    void contextOfAnInstanceThatWasReplaced_hasNoEffectOnTheNextOne() {
        Doer doer = test.spawn(
                Doer.class, Doer::new, ActorSettings.defaults().withSupervision(Supervision.restart(3, SECOND)));
        ActorContext kept = contextOf(doer);
        doer.run(me -> {
            throw new IllegalStateException("on purpose");
        });
        test.runQueued();
        assertThat(takeErrors()).containsExactly("on purpose");
        assertEnded(kept);
        log.clear();
        doer.run(me -> log.add("serves, and has a context of its own: " + (me.context() != kept)));
        test.runQueued();
        assertThat(log).containsExactly("serves, and has a context of its own: true");
    }

    @Test
    void objectThatIsStartedAgain_keepsItsContext() {
        var only = new Doer();
        Doer doer = test.spawn(
                Doer.class, () -> only, ActorSettings.defaults().withSupervision(Supervision.restart(3, SECOND)));
        ActorContext kept = contextOf(doer);
        doer.run(me -> {
            throw new IllegalStateException("on purpose");
        });
        test.runQueued();
        assertThat(takeErrors()).containsExactly("on purpose");
        inSpace(() -> kept.after(SECOND, () -> log.add("timer")));
        test.advance(SECOND);
        assertThat(log).containsExactly("timer");
        assertThat(contextOf(doer)).isSameAs(kept);
    }

    @Test
    void objectOfAnotherActor_isRefused_andThatGoesOn() {
        var shared = new Doer();
        Doer first = test.spawn(Doer.class, () -> shared);
        first.run(me -> me.context().after("key", SECOND, () -> log.add("timer of the first")));
        Doer second = test.spawn(Doer.class, () -> shared);
        Promise<String> asked = second.ask(me -> Promise.of("served"))
                .exceptionally(error -> error.getClass().getSimpleName());
        test.runQueued();
        assertThat(takeErrors())
                .singleElement()
                .asString()
                .contains("the factory of Doer#2 returned an object that is the actor Doer#1 already");
        assertThat(values(asked)).containsExactly("ActorStoppedException");
        test.advance(SECOND);
        assertThat(log).containsExactly("timer of the first");
    }

    /** Each call of a context, by the name in its error. */
    @ParameterizedTest
    @ValueSource(
            strings = {
                "space()",
                "stop()",
                "hold()",
                "release()",
                "after(..)",
                "every(..)",
                "cancelTimer(..)",
                "isTimerActive(..)",
                "repeatWhile(..)"
            })
    void callsOnAnotherThread_areRefused_withTheirNameAndTheActor(String call) {
        ActorContext context = contextOf(test.spawn(Doer.class, Doer::new));
        List<Consumer<ActorContext>> calls = switch (call) {
            case "space()" -> List.of(ActorContext::space);
            case "stop()" -> List.of(ActorContext::stop);
            case "hold()" -> List.of(ActorContext::hold);
            case "release()" -> List.of(ActorContext::release);
            case "after(..)" -> List.of(it -> it.after(SECOND, () -> {}), it -> it.after("key", SECOND, () -> {}));
            case "every(..)" -> List.of(it -> it.every(SECOND, () -> {}), it -> it.every("key", SECOND, () -> {}));
            case "cancelTimer(..)" -> List.of(it -> it.cancelTimer("key"));
            case "isTimerActive(..)" -> List.of(it -> it.isTimerActive("key"));
            default ->
                List.of(
                        it -> it.repeatWhile(() -> true, () -> {}),
                        it -> it.repeatWhile(() -> true, () -> Promise.done()));
        };
        for (Consumer<ActorContext> each : calls) {
            assertThatThrownBy(() -> each.accept(context))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageStartingWith(
                            "context()." + call + " of Doer#1 belongs on the thread of space test-space");
        }
    }

    interface Race {
        void started();

        default void stopped() {}
    }

    private class Runner extends Actor implements Race {
        @Override
        public void started() {
            log.add("hook or message?");
        }

        @Override
        public void stopped() {
            log.add("hook or message?");
        }
    }

    @Test
    void messageThatIsAHookOfItsImplementation_isRefusedByName() {
        Race race = test.spawn(
                Race.class, Runner::new, ActorSettings.defaults().withSupervision(Supervision.restart(3, SECOND)));
        Promise<ActorEnd> end = test.space().whenStopped(race);
        test.runQueued();
        var problem = test.takeProblems().getFirst();
        assertThat(problem.error())
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContainingAll(
                        "Race.started() of actor type io.troupe.actor.ActorContextTest$Race is a message",
                        "Runner also the hook Actor.started()",
                        "give the message another name");
        assertThat(test.get(end)).isEqualTo(new ActorEnd.Failed(problem.error()));
        assertThat(log).isEmpty();
    }

    @Test
    void messageWithTheNameOfAHook_isOneLikeOthers_ifItsImplementationIsNoActor() {
        Race race = test.spawn(Race.class, () -> () -> log.add("message"));
        race.started();
        race.stopped();
        test.runQueued();
        assertThat(log).containsExactly("message");
    }

    @Test
    void spaceOfAProxy_isThatOfItsActor() {
        Motor motor = test.spawn(Motor.class, GearMotor::new);
        assertThat(ActorSpace.of(motor)).isSameAs(test.space());
        stop(motor);
        assertThat(ActorSpace.of(motor)).isSameAs(test.space());
        assertThat(log).containsExactly("the end");
        var pool = ActorPool.on(List.of(test.space()), Doer.class, Doer::new, ActorSettings.defaults());
        assertThat(ActorSpace.of(pool.actors().getFirst())).isSameAs(test.space());
        for (Object other : List.of("text", new Doer(), pool.roundRobin(), test.space())) {
            assertThatThrownBy(() -> ActorSpace.of(other))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("the value is a " + other.getClass().getName() + ", expected the proxy of an actor");
        }
        test.runQueued();
        assertThatThrownBy(() -> ActorSpace.of(null))
                .isInstanceOf(NullPointerException.class)
                .hasMessage("proxy");
    }

    @Test
    void deferred_isOfTheSpaceThatMadeIt_ofTheCallers_orOfNone() {
        ActorSpace space = test.space();
        var inSpace = new ArrayList<Deferred<String>>();
        inSpace(() -> inSpace.addAll(List.of(new Deferred<>(), Deferred.unbound())));
        String now = "listener ran at once";
        for (Deferred<String> ofSpace : List.of(space.<String>deferred(), inSpace.getFirst())) {
            ofSpace.then(text -> log.add(now));
            ofSpace.resolve("");
            assertThat(log).isEmpty();
            test.runQueued();
            assertThat(log).containsExactly(now);
            log.clear();
        }
        for (Deferred<String> ofNone : List.of(new Deferred<String>(), Deferred.<String>unbound(), inSpace.getLast())) {
            ofNone.then(text -> log.add(now));
            ofNone.resolve("");
            assertThat(log).containsExactly(now);
            log.clear();
        }
        space.deferred().reject(new IllegalStateException("reported"));
        Deferred.unbound().reject(new IllegalStateException("of no space"));
        test.advance(SECOND.multipliedBy(2));
        assertThat(takeErrors()).containsExactly("reported");
    }
}
