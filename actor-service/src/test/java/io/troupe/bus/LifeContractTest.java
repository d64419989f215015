package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedClass;
import org.junit.jupiter.params.provider.EnumSource;

/** Ports, actors and spaces that are opened and closed. */
@ParameterizedClass
@EnumSource(BusContract.Wiring.class)
class LifeContractTest extends BusContract {
    LifeContractTest(Wiring wiring) {
        super(wiring);
    }

    interface Listener {
        void listen(BusPort port);

        void listenOnce(BusPort port);

        void askAndForget(BusPort port, Address to);
    }

    static final class ListenerActor extends Actor implements Listener {
        private final List<Integer> heard;

        ListenerActor(List<Integer> heard) {
            this.heard = heard;
        }

        @Override
        public void listen(BusPort port) {
            port.subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        }

        @Override
        public void listenOnce(BusPort port) {
            port.subscribe(COUNTS, (count, from) -> {
                heard.add(count.value());
                stop();
            });
        }

        @Override
        public void askAndForget(BusPort port, Address to) {
            port.ask(to, SPELL, new Count(1), SECOND).thenAccept(text -> heard.add(1));
        }
    }

    @Test
    void actorThatHasStopped_receivesNothingAnyMore() {
        var heard = new ArrayList<Integer>();
        var listener = test.spawn(Listener.class, () -> new ListenerActor(heard));
        var port = far().attach("a");
        listener.listen(port);
        test.crank();
        var publisher = near().attach("publisher");
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        test.space().stop(listener);
        test.crank();
        publisher.publish(COUNTS, new Count(2));
        test.crank();
        assertThat(heard).containsExactly(1);
        assertThat(take(losses)).singleElement().isInstanceOf(Loss.Discarded.class);
        publisher.publish(COUNTS, new Count(3));
        test.crank();
    }

    @Test
    void actorThatStopsWithValuesOnTheirWay_isMissedWithTheNextValue_andAllAreReported() {
        var heard = new ArrayList<Integer>();
        var listener = test.spawn(Listener.class, () -> new ListenerActor(heard));
        var port = near().attach("a");
        listener.listenOnce(port);
        listener.listenOnce(port);
        test.crank();
        var publisher = near().attach("publisher");
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        assertThat(heard)
                .as("heard by the first subscription, whose actor stopped then")
                .containsExactly(1);
        publisher.publish(COUNTS, new Count(2));
        assertThat(take(losses).stream().map(loss -> ((Loss.Discarded) loss).count()))
                .as("unheard by the first and by the second")
                .containsExactly(1, 2);
        test.crank();
    }

    @Test
    void otherSpace_receivesOnItsThread_andHasItsClock() {
        var other = new TestSpace();
        var port = far().attach("a");
        var heard = new ArrayList<Integer>();
        other.run(() -> port.subscribe(COUNTS, (count, from) -> {
            assertThat(ActorSpace.current()).isSameAs(other.space());
            heard.add(count.value());
        }));
        near().attach("publisher").publish(COUNTS, new Count(1));
        test.crank();
        assertThat(heard).isEmpty();
        other.crank();
        assertThat(heard).containsExactly(1);
        var hanging = far().attach("hanging");
        hanging.answer(SPELL, count -> new Deferred<>());
        var requester = near().attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        other.run(() -> answers.add(heard(requester.ask(hanging.address(), SPELL, new Count(1), SECOND))));
        test.advance(SECOND.multipliedBy(2));
        assertThat(answers.getFirst().isDone()).isFalse();
        other.advance(SECOND.multipliedBy(2));
        assertThat(other.error(answers.getFirst())).hasMessageEndingWith("no answer within PT1S");
        far().close();
        test.crank();
        take(losses);
        other.close();
    }

    @Test
    void name_canBeTakenOnce_andIsFreeAgainWhenItsPortIsClosed() {
        var port = far().attach("a");
        assertThatThrownBy(() -> far().attach("a"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("the name " + far().node() + "/a is taken; there are a on node");
        port.close();
        port.close();
        assertThat(far().attach("a").address()).isEqualTo(port.address());
    }

    @Test
    void port_thatIsClosed_refusesByName() {
        var port = near().attach("a");
        port.close();
        assertThatThrownBy(() -> port.publish(COUNTS, new Count(1)))
                .isInstanceOf(BusException.class)
                .hasMessage(port.address() + " cannot publish on counts: it has left the bus");
        assertThatThrownBy(() -> port.subscribe(COUNTS, (count, from) -> {})).isInstanceOf(BusException.class);
        assertThatThrownBy(() -> port.answer(SPELL, BusContract::spelt)).isInstanceOf(BusException.class);
        assertThat(refusalOf(port.ask(port.address(), SPELL, new Count(1), SECOND)))
                .endsWith("the asker has left: it has left the bus");
    }

    @Test
    void busThatIsClosed_rejectsWhatWaits_andTakesNobody() {
        var handler = far().attach("speller");
        handler.answer(SPELL, count -> new Deferred<>());
        var requester = near().attach("asker");
        var answer = requester.ask(handler.address(), SPELL, new Count(1), SECOND);
        test.crank();
        near().close();
        assertThat(refusalOf(answer)).contains("the bus " + near().node() + " is closed");
        assertThatThrownBy(() -> near().attach("b"))
                .isInstanceOf(BusException.class)
                .hasMessageContaining("is closed");
        far().close();
        test.crank();
        take(losses);
    }
}
