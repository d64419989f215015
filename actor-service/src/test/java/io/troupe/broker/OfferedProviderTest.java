package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.internal.OwnName;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** A provider of another process, whose broker the test plays message by message. */
class OfferedProviderTest extends HostsBench {
    private static final Address PARROT_OF_PEER = new Address("peer", "parrot");
    private static final String ADDRESS = PARROT_OF_PEER.toString();
    private static final List<String> METHODS =
            List.of("count(int, Callback)", "fail(String)", "hear(String)", "say(String)", "sayLater(String)");

    private final Host near = host("near");
    private final Peer peer = new Peer();

    /** The other process. It answers no call, and a start or check when the test does. */
    private final class Peer {
        final Bus bus = pipe.open("peer", BusSettings.on(test.space()).withObserver(loss -> {}));
        final BusPort port = bus.attach(new OwnName(MESSAGES.port));
        final BusPort parrot = bus.attach("parrot");
        final Deque<Deferred<OfferMessages.Started>> starts = new ArrayDeque<>();
        final Deque<Deferred<OfferMessages.Checked>> checks = new ArrayDeque<>();
        final List<CallMessages.Call> calls = new ArrayList<>();
        long incarnation = 7;
        long count;

        Peer() {
            port.answer(OfferMessages.START, start -> waiting(starts));
            port.answer(OfferMessages.CHECK, check -> waiting(checks));
            parrot.answer(CallMessages.CALL, call -> {
                calls.add(call);
                return Deferred.unbound();
            });
        }

        private static <T> Promise<T> waiting(Deque<Deferred<T>> all) {
            all.add(Deferred.unbound());
            return all.getLast();
        }

        void offer(Health health, long life) {
            offer(health, life, List.of("talks"), 0, METHODS);
        }

        void offer(Health health, long life, List<String> capabilities, int rank, List<String> methods) {
            offers(new OfferMessages.Offer("parrot", "parrot", capabilities, health, rank, life, methods));
        }

        void offers(OfferMessages.Offer... offers) {
            port.publish(MESSAGES.offers, new OfferMessages.Offers(incarnation, ++count, List.of(offers)));
            test.runQueued();
        }

        void started(long life) {
            starts.remove().resolve(new OfferMessages.Started(life));
            test.runQueued();
        }

        void checked(boolean suspect) {
            checks.remove().resolve(new OfferMessages.Checked(suspect));
            test.runQueued();
        }
    }

    @AfterEach
    void closePeer() {
        peer.bus.close();
        losses.clear(); // what near still sends to it
    }

    private void advance(long millis) {
        test.advance(Duration.ofMillis(millis));
        test.runQueued();
    }

    /** The peer offers its parrot, and near uses its first life. */
    private Parrot used() {
        peer.offer(Health.NOT_STARTED, 0);
        var parrot =
                near.connect(ConnectionSettings.defaults().withoutAnswerLimit()).actor();
        test.runQueued();
        peer.started(1);
        peer.offer(Health.WELL, 1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
        return parrot;
    }

    private String whyFailed() {
        return near.events(BrokerEvent.Failed.class).getLast().why().getMessage();
    }

    // ---- lives

    @Test
    void endThatIsReportedBeforeTheReplyToTheStart_counts() {
        peer.offer(Health.NOT_STARTED, 0);
        var required = near.broker.require(PARROT);
        test.runQueued();
        peer.offer(Health.FAILED, 1);
        peer.started(1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.FAILED);
        assertThat(test.error(required)).hasMessageContaining("peer/parrot (peer/parrot has ended)");
        assertThat(near.services.find(PARROT_OF_PEER)).isNull();
    }

    @Test
    void endThatIsReportedRightAfterTheReplyToTheStart_counts() {
        peer.offer(Health.NOT_STARTED, 0);
        near.connected();
        test.runQueued();
        peer.starts.remove().resolve(new OfferMessages.Started(1));
        peer.offer(Health.FAILED, 1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.FAILED);
    }

    @Test
    void laterLife_endsTheEarlierOne_withItsCalls_andIsUsed() {
        var call = used().sayLater("x");
        test.runQueued();
        peer.offer(Health.STARTING, 2);
        assertThat(test.error(call)).hasMessageStartingWith("peer/parrot ended while \"robot 1\" waited");
        assertThat(near.services.find(PARROT_OF_PEER)).isNull();
        peer.offer(Health.WELL, 2);
        peer.started(2);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
    }

    @Test
    void laterLife_whoseStartWasNotSeen_isUsedToo() {
        used();
        peer.offer(Health.WELL, 2);
        peer.started(2);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
        assertThat(near.events(BrokerEvent.Failed.class)).hasSize(1);
    }

    @Test
    void providerThatWasStopped_cannotBeFound() {
        used();
        peer.offers();
        assertThat(near.services.find(PARROT_OF_PEER)).isNull();
    }

    @Test
    void checkOfAnEarlierLife_doesNotEndALaterOne() {
        var parrot = used();
        peer.parrot.close();
        assertThat(test.error(parrot.say("x"))).hasMessageContaining("was not delivered");
        var doubt = peer.checks.removeLast();
        peer.offer(Health.FAILED, 1);
        peer.offer(Health.WELL, 2);
        peer.started(2);
        doubt.reject(new ProviderException("life 1 has ended"));
        advance(1_000);
        assertThat(peer.checks).as("of life 2").hasSize(1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
        assertThat(near.services.find(PARROT_OF_PEER)).isNotNull();
    }

    @Test
    void severalCallsThatAreNotDelivered_causeOneCheck() {
        var parrot = used();
        peer.parrot.close();
        var first = parrot.say("1");
        var second = parrot.say("2");
        test.runQueued();
        assertThat(test.error(Promise.any(List.of(first, second)))).isNotNull();
        assertThat(peer.checks).hasSize(1);
        peer.checked(false);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
        assertThat(test.error(parrot.say("3"))).hasMessageContaining("was not delivered");
        peer.checks.remove().reject(new ProviderException("life 1 has ended"));
        test.runQueued();
        assertThat(near.health(ADDRESS)).isEqualTo(Health.FAILED);
    }

    @Test
    void defaultMethodThatTheProviderDoesNotKnow_failsAlone() {
        var parrot = used();
        var unknown = parrot.sayTwice("x");
        assertCallError(
                unknown,
                false,
                "Parrot.sayTwice(String) of \"robot 1\", which needs the service \"parrot\", was rejected: peer/parrot has"
                        + " no sayTwice(String); it has count(int, Callback), fail(String), hear(String), say(String),"
                        + " sayLater(String)");
        var known = parrot.sayLater("x");
        test.runQueued();
        peer.offer(Health.STARTING, 2);
        assertThat(test.error(known)).hasMessageStartingWith("peer/parrot ended while");
    }

    // ---- health

    @Test
    void startByTheOtherBroker_endsBeforeTheLimitOfThisOne() {
        peer.offer(Health.NOT_STARTED, 0);
        var required = near.broker.require(PARROT);
        test.runQueued();
        for (int millis = 0; millis < 7_500; millis += 500) {
            assertThat(required.isDone()).isFalse();
            advance(500); // the request may be lost, and is repeated
        }
        assertThat(test.error(required)).hasMessageContaining("asked peer/$broker for start: no answer within");
        assertThat(peer.starts).hasSizeGreaterThan(1);
    }

    @Test
    void checksByTheOtherBroker_endBeforeTheLimitOfThisOne() {
        used();
        advance(1_000);
        advance(750);
        assertThat(near.events(BrokerEvent.Suspect.class).getLast().why())
                .hasMessage("near/$broker asked peer/$broker for check: no answer within PT0.75S");
    }

    @Test
    void health_isTheWorseOfBothBrokers() {
        used();
        peer.offer(Health.SUSPECT, 1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.SUSPECT);
        peer.offer(Health.WELL, 1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
        advance(1_000);
        peer.checked(true);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.SUSPECT);
        assertThat(near.events(BrokerEvent.Suspect.class).getLast().why())
                .hasMessage("peer/parrot has not answered its own broker in time");
    }

    @Test
    void silence_makesAProviderInUseSuspect_althoughItAnswersItsChecks_untilItsNextOffer() {
        used();
        for (int second = 0; second < 4; second++) {
            advance(1_000);
            peer.checks.forEach(check -> check.resolve(new OfferMessages.Checked(false)));
            peer.checks.clear();
            test.runQueued();
        }
        assertThat(near.events(BrokerEvent.Suspect.class)).isEmpty();
        assertThat(near.health(ADDRESS)).isEqualTo(Health.SUSPECT);
        peer.offer(Health.WELL, 1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
    }

    @Test
    void processThatWasSilent_isUsedAgain_whenItOffersTheSameLife() {
        used();
        seconds(8);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.FAILED);
        peer.offer(Health.WELL, 1);
        peer.started(1);
        assertThat(near.health(ADDRESS)).isEqualTo(Health.WELL);
    }

    // ---- offers

    @Test
    void offerThatDiffers_isAnotherProvider() {
        near.publish("mine");
        peer.offer(Health.NOT_STARTED, 0);
        peer.offer(Health.NOT_STARTED, 1, List.of("sings"), 0, METHODS);
        assertThat(get(near.broker.find(Need.ofCapability("user", "sings")))).hasSize(1);
        assertThat(near.found()).startsWith("near/parrot");
        peer.offer(Health.NOT_STARTED, 1, List.of("sings"), -1, METHODS);
        assertThat(near.found()).containsExactly(ADDRESS, "near/parrot");
        assertThat(near.events(BrokerEvent.Withdrawn.class))
                .as("another rank alone is the same provider")
                .hasSize(1);
        peer.offers(new OfferMessages.Offer("parrot", "songs", List.of("sings"), Health.NOT_STARTED, -1, 1, METHODS));
        assertThat(get(near.broker.find(Need.ofService("user", "songs")))).hasSize(1);
        assertThat(near.found()).containsExactly("near/parrot");
    }

    @Test
    void offerWithOtherMethods_isAnotherProvider() {
        peer.offer(Health.NOT_STARTED, 0, List.of(), 0, List.of("say(String)"));
        var connection = near.connect(ConnectionSettings.defaults());
        test.runQueued();
        peer.started(1);
        assertThat(test.error(connection.first())).hasMessageContaining("has no count(int, Callback)");
        peer.offer(Health.WELL, 1, List.of(), 0, METHODS);
        peer.started(1);
        connection.actor().hear("x");
        test.runQueued();
        assertThat(peer.calls).hasSize(1);
    }

    @Test
    void offerWithoutMethods_isNoActor() {
        peer.offer(Health.NOT_STARTED, 0, List.of(), 0, List.of());
        var connection = near.connect(ConnectionSettings.defaults());
        test.runQueued();
        peer.started(1);
        assertThat(test.error(connection.first()))
                .hasMessageEndingWith("its provider peer/parrot is no actor that can be called from other hosts");
    }

    @Test
    void actorThatHasEnded_getsNoCalls_beforeItsConnectionIsNotified() {
        var actor = new RemoteActor(PARROT_OF_PEER, METHODS, new CallableInterfaces());
        assertThat(actor.hasEnded()).isFalse();
        actor.end();
        assertThat(actor.hasEnded()).isTrue();
    }

    @Test
    void lateOffers_ofAnEarlierIncarnation_areIgnored() {
        peer.offer(Health.NOT_STARTED, 0);
        peer.incarnation = 8;
        peer.offer(Health.NOT_STARTED, 0);
        peer.incarnation = 7;
        peer.offers();
        assertThat(near.health(ADDRESS)).isEqualTo(Health.NOT_STARTED);
        assertThat(near.events(BrokerEvent.Withdrawn.class)).hasSize(1);
    }

    @Test
    void processThatIsStartedAgain_endsWhatItOffered_andTheReasonIsNamed() {
        used();
        peer.incarnation = 8;
        peer.offer(Health.NOT_STARTED, 0);
        assertThat(whyFailed()).isEqualTo("peer/parrot has ended: the process peer was started again");
    }

    @Test
    void callOfAWithdrawnProvider_waitsForItsAnswer_untilItsProcessIsGone() {
        var call = used().sayLater("x");
        test.runQueued();
        peer.offers();
        advance(1_000);
        assertThat(call.isDone()).isFalse();
        peer.incarnation = 8;
        peer.offers();
        assertThat(test.error(call)).hasMessageStartingWith("peer/parrot ended while \"robot 1\" waited");
    }

    // ---- streams

    /** A part of the stream of the last call, which was {@code count}. */
    private CallMessages.StreamPart part(long number, CallMessages.Part content) {
        var arguments = peer.calls.getLast().arguments().reader();
        arguments.readArray();
        arguments.readLong(0, 9);
        arguments.readMap();
        arguments.readText();
        return new CallMessages.StreamPart(arguments.readLong(0, Long.MAX_VALUE), number, content);
    }

    private Promise<CallMessages.Received> sendToCaller(CallMessages.StreamPart part) {
        return peer.parrot.ask(new Address("near", "$caller-1"), CallMessages.STREAM, part, Duration.ofSeconds(1));
    }

    @Test
    void streamWithAnItem_goesOnWithoutAReplyToItsCall_becauseTheCallIsExecuted() {
        var probe = test.<Integer>callback();
        used().count(3, probe);
        test.runQueued();
        var one = new CallableMethods.Values().encode(Integer.class, 1);
        assertThat(get(sendToCaller(part(1, new CallMessages.Item(one)))).wantsMore())
                .isTrue();
        passLimitOfTheCall();
        assertThat(probe.results()).containsExactly(1);
        probe.expectOpen();
        assertThat(get(sendToCaller(part(2, new CallMessages.End()))).wantsMore())
                .isFalse();
        probe.expectFinished();
    }

    @Test
    void streamWithoutItemsAndWithoutAReplyToItsCall_fails_becauseTheCallMayBeLost() {
        var probe = test.<Integer>callback();
        used().count(3, probe);
        passLimitOfTheCall();
        assertThat(probe.expectFailed()).hasMessageContaining("no answer within PT5S");
        assertThat(get(sendToCaller(part(1, new CallMessages.End()))).wantsMore())
                .isFalse();
    }

    private void passLimitOfTheCall() {
        for (int second = 0; second < 8; second++) {
            advance(1_000);
            peer.checks.forEach(check -> check.resolve(new OfferMessages.Checked(false)));
            peer.offer(Health.WELL, 1);
        }
    }

    @Test
    void streamThatHasEnded_wantsNoMore() {
        var parrot = used();
        parrot.hear("x");
        test.runQueued();
        assertThat(get(sendToCaller(new CallMessages.StreamPart(99, 1, new CallMessages.End())))
                        .wantsMore())
                .isFalse();
    }

    @Test
    void itemThatCannotBeRead_endsTheStream() {
        var probe = test.<Integer>callback();
        used().count(3, probe);
        test.runQueued();
        var text = new CallableMethods.Values().encode(String.class, "three");
        assertThat(get(sendToCaller(part(1, new CallMessages.Item(text)))).wantsMore())
                .isFalse();
        assertThat(probe.expectFailed())
                .hasMessageStartingWith(
                        "an item of the stream of Parrot.count(int, Callback) from peer/parrot cannot" + " be read: ");
    }

    @Test
    void streamsOfAnActorThatHasEnded_fail_andThoseOfOthersDoNot() {
        var streams = new IncomingStreams(new CallableMethods.Values());
        var first = new RemoteActor(PARROT_OF_PEER, METHODS, new CallableInterfaces());
        var second = new RemoteActor(PARROT_OF_PEER, METHODS, new CallableInterfaces());
        List<String> ended = new ArrayList<>();
        streams.open(first, "count", (item, error) -> ended.add("first"), Integer.class);
        streams.open(second, "count", (item, error) -> ended.add("second"), Integer.class);
        streams.failAllOf(first, new IllegalStateException("gone"));
        streams.failAllOf(first, new IllegalStateException("gone"));
        assertThat(ended).containsExactly("first");
    }

    private final List<CallMessages.Part> parts = new ArrayList<>();
    private final Deque<Deferred<CallMessages.Received>> received = new ArrayDeque<>();

    /** A stream to a reader that records the parts, and does not answer them. */
    private OutgoingStream outgoing() {
        var reader = peer.bus.attach("reader");
        reader.answer(CallMessages.STREAM, part -> {
            parts.add(part.part());
            return Peer.waiting(received);
        });
        var port = near.bus.attach("sender");
        return new OutgoingStream(test.space(), port, reader.address(), 1, Integer.class, new CallableMethods.Values());
    }

    @Test
    void streamThatItsSenderHasEnded_sendsWhatItHasKept_andNothingMore() {
        var stream = outgoing();
        for (int i = 1; i <= OutgoingStream.MOST_UNANSWERED + 1; i++) {
            stream.next(i);
        }
        stream.finish();
        stream.next(0);
        stream.fail(new IllegalStateException("no more"));
        test.runQueued();
        assertThat(parts).hasSize(OutgoingStream.MOST_UNANSWERED);
        received.forEach(each -> each.resolve(new CallMessages.Received(true)));
        test.runQueued();
        assertThat(parts).hasSize(OutgoingStream.MOST_UNANSWERED + 2).endsWith(new CallMessages.End());
    }

    @Test
    void streamWhoseReaderDoesNotAnswer_endsHere_andTheReaderIsNotified() {
        var stream = outgoing();
        stream.next(1);
        advance(10_000);
        assertThat(stream.isCancelled()).isTrue();
        assertThat(parts).hasSize(2);
        assertThat(parts.getLast())
                .isInstanceOfSatisfying(
                        CallMessages.Failed.class,
                        failed -> assertThat(failed.message()).contains("no answer within PT10S"));
    }

    // ---- what near publishes

    private List<OfferMessages.Offers> publishedByNear() {
        List<OfferMessages.Offers> published = new ArrayList<>();
        peer.bus.attach("listener").subscribe(MESSAGES.offers, (offers, from) -> {
            if (from.node().equals("near")) {
                published.add(offers);
            }
        });
        return published;
    }

    @Test
    void offers_arePublishedAtOnce_onlyIfTheyHaveChanged() {
        var published = publishedByNear();
        used();
        assertThat(near.events).isNotEmpty();
        assertThat(published).isEmpty();
        near.publish("mine");
        test.runQueued();
        assertThat(published).hasSize(1);
        advance(1_000);
        assertThat(published).hasSize(2);
    }

    @Test
    void brokerThatIsShutDown_publishesThatItHasNoOffers_beforeItsProvidersStop_andThenNothing() {
        near.publish("mine");
        get(near.broker.require(PARROT));
        var published = publishedByNear();
        Deferred<Void> slow = Deferred.unbound();
        get(near.broker.register("slow", List.of(), new Address("near", "slow"), new SlowToStop(slow)));
        get(near.broker.require(Need.ofService("user", "slow")));
        published.clear();
        var shutDown = near.broker.closeAsync();
        test.runQueued();
        assertThat(shutDown.isDone()).isFalse();
        assertThat(published).last().satisfies(last -> assertThat(last.offers()).isEmpty());
        slow.resolve(null);
        get(shutDown);
        published.clear();
        advance(5_000);
        assertThat(published).isEmpty();
        near.bus.attach(new OwnName(MESSAGES.port)).close(); // the name is free again
    }

    private record SlowToStop(Deferred<Void> stopped) implements Provider {
        @Override
        public Promise<Void> start() {
            return Promise.done();
        }

        @Override
        public Promise<Void> stop() {
            return stopped;
        }

        @Override
        public Promise<Void> check() {
            return Promise.done();
        }
    }

    @Test
    void brokerWhoseSpaceIsClosed_leavesItsPort_andEndsTheCallsUnderWay() {
        try (var brokers = new TestSpace()) {
            var bus = pipe.open("other", BusSettings.on(test.space()).withObserver(loss -> {}));
            var broker =
                    Broker.over(bus, brokers.space(), BrokerSettings.defaults().withObserver(event -> {}));
            var services = broker.services();
            Runnable runBoth = () -> {
                for (int i = 0; i < 10; i++) {
                    brokers.runQueued();
                    test.runQueued();
                }
            };
            runBoth.run();
            peer.offer(Health.WELL, 1);
            var calls = new ArrayList<Promise<String>>();
            test.run(() -> calls.add(services.connect(
                            Parrot.class, PARROT, ConnectionSettings.defaults().withoutAnswerLimit())
                    .actor()
                    .sayLater("x")));
            var call = calls.getFirst();
            runBoth.run();
            peer.started(1);
            runBoth.run();
            assertThat(peer.calls).hasSize(1);
            brokers.runQueued();
            brokers.space().close();
            brokers.runQueued();
            assertThat(test.error(call)).hasMessageStartingWith("peer/parrot ended while \"robot 1\" waited");
            bus.attach(new OwnName(MESSAGES.port));
            bus.close();
        }
    }

    @Test
    void afterAReconnection_offersAreAskedFor() {
        List<Address> asking = new ArrayList<>();
        peer.port.subscribe(MESSAGES.ask, (ask, from) -> asking.add(from));
        seconds(3);
        pipe.disconnect("near");
        seconds(3);
        assertThat(asking).isEmpty();
        advance(500);
        pipe.reconnect("near");
        advance(500);
        assertThat(asking).containsExactly(new Address("near", "$broker"));
        seconds(5);
        assertThat(asking).hasSize(1);
    }
}
