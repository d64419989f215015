package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.atomic.AtomicInteger;
import kotlin.ResultKt;
import kotlin.Unit;
import kotlin.coroutines.Continuation;
import kotlin.coroutines.CoroutineContext;
import kotlin.coroutines.EmptyCoroutineContext;
import kotlin.coroutines.intrinsics.CoroutineSingletons;
import kotlin.coroutines.jvm.internal.ContinuationImpl;
import kotlinx.coroutines.BuildersKt;
import kotlinx.coroutines.CompletableDeferred;
import kotlinx.coroutines.CompletableDeferredKt;
import kotlinx.coroutines.CoroutineScope;
import kotlinx.coroutines.CoroutineScopeKt;
import kotlinx.coroutines.CoroutineStart;
import kotlinx.coroutines.ExecutorsKt;
import kotlinx.coroutines.channels.BufferOverflow;
import kotlinx.coroutines.channels.Channel;
import kotlinx.coroutines.channels.ChannelKt;
import org.jspecify.annotations.Nullable;

/**
 * Kotlin's coroutines: one coroutine and one unlimited channel for each actor, all on one thread; an answer is a
 * {@code CompletableDeferred}. The coroutines are written in Java, as the Kotlin compiler would translate them.
 */
final class ChannelContender implements Contender {
    private final CompletionLatch finish = new CompletionLatch();
    private final ExecutorService thread =
            Executors.newSingleThreadExecutor(Thread.ofPlatform().daemon().factory());
    private final CoroutineScope scope = CoroutineScopeKt.CoroutineScope(ExecutorsKt.from(thread));
    private final Counter counter = new Counter();
    private final Counter other = new Counter();
    private final List<Counter> created = new ArrayList<>();

    /** An actor: its channel. */
    public abstract static class Mailbox<M> {
        private final Channel<M> channel = ChannelKt.Channel(Channel.UNLIMITED, BufferOverflow.SUSPEND, null);

        /** Starts the coroutine of the actor. */
        public final void start(CoroutineScope scope) {
            BuildersKt.launch(
                    scope,
                    EmptyCoroutineContext.INSTANCE,
                    CoroutineStart.DEFAULT,
                    (here, completion) -> new Receiver<>(this, completion).receive());
        }

        /** Sends a message; an unlimited channel never suspends its sender. */
        public final void send(M message) {
            channel.send(message, NeverResumed.INSTANCE);
        }

        final void stop() {
            channel.cancel(null);
        }

        /**
         * Handles a message.
         *
         * @param receiver resumed later if this has suspended
         * @return {@code COROUTINE_SUSPENDED} if this has suspended
         */
        public abstract @Nullable Object handle(M message, Receiver<M> receiver);

        /** Continues the message that has suspended, like {@link #handle}. */
        @Nullable
        Object resume(Receiver<M> receiver) {
            throw new IllegalStateException("this actor never suspends");
        }
    }

    /** The coroutine {@code for (message in channel) handle(message)}. */
    @SuppressWarnings("serial") // Kotlin's continuations are serializable, and nothing here uses that
    public static final class Receiver<M> extends ContinuationImpl {
        private final Mailbox<M> mailbox;
        private boolean handling; // suspended within a message, not between two

        Receiver(Mailbox<M> mailbox, Continuation<? super Unit> completion) {
            super(erased(completion));
            this.mailbox = mailbox;
        }

        @SuppressWarnings("unchecked") // Kotlin erases the type
        private static Continuation<Object> erased(Continuation<? super Unit> completion) {
            return (Continuation<Object>) (Continuation<?>) completion;
        }

        @Nullable
        Object receive() {
            return receiveAfter(Unit.INSTANCE);
        }

        @Override
        protected @Nullable Object invokeSuspend(Object result) {
            ResultKt.throwOnFailure(result);
            return receiveAfter(handling ? mailbox.resume(this) : handle(result));
        }

        /** Receives messages until one of them, or the channel, suspends. */
        private @Nullable Object receiveAfter(@Nullable Object outcome) {
            Object last = outcome;
            while (last != CoroutineSingletons.COROUTINE_SUSPENDED) {
                handling = false;
                Object message = mailbox.channel.receive(own());
                last = message == CoroutineSingletons.COROUTINE_SUSPENDED ? message : handle(message);
            }
            return last;
        }

        @SuppressWarnings("unchecked") // the channel delivers messages of type M
        private @Nullable Object handle(@Nullable Object message) {
            handling = true;
            return mailbox.handle((M) message, this);
        }

        /** This continuation, for a function that returns a {@code T}. */
        @SuppressWarnings("unchecked") // Kotlin erases the type
        final <T> Continuation<T> own() {
            return (Continuation<T>) this;
        }
    }

    /** The continuation of a sender that never suspends. */
    private enum NeverResumed implements Continuation<Unit> {
        INSTANCE;

        @Override
        public CoroutineContext getContext() {
            return EmptyCoroutineContext.INSTANCE;
        }

        @Override
        public void resumeWith(Object result) {
            throw new IllegalStateException("an unlimited channel has suspended its sender");
        }
    }

    private sealed interface Message {}

    private record Expect(int messages) implements Message {}

    private record Add(int amount) implements Message {}

    private record Ping(Counter from, int hops) implements Message {}

    private record Sum(CompletableDeferred<Integer> answer) implements Message {}

    private record AskInTurn(Counter whom, int asks) implements Message {}

    private record Begin(AtomicInteger beginners) implements Message {}

    private final class Counter extends Mailbox<Message> {
        private int sum;
        private int left;
        private int asks;
        private @Nullable Counter asked;

        Counter() {
            start(scope);
        }

        @Override
        public @Nullable Object handle(Message message, Receiver<Message> receiver) {
            switch (message) {
                case Expect expect -> left = expect.messages();
                case Add add -> add(add.amount());
                case Ping ping -> ping(ping);
                case Sum ask -> ask.answer().complete(sum);
                case Begin begin -> begin(begin.beginners());
                case AskInTurn chain -> {
                    asked = chain.whom();
                    asks = chain.asks();
                    return askInTurn(receiver);
                }
            }
            return Unit.INSTANCE;
        }

        @Override
        @Nullable
        Object resume(Receiver<Message> receiver) {
            return askInTurn(receiver);
        }

        /** The loop {@code repeat(asks) { whom.ask().await() }}. */
        private @Nullable Object askInTurn(Receiver<Message> receiver) {
            while (asks-- > 0) {
                Object result = Objects.requireNonNull(asked).ask().await(receiver.own());
                if (result == CoroutineSingletons.COROUTINE_SUSPENDED) {
                    return result;
                }
            }
            finish.reach();
            return Unit.INSTANCE;
        }

        CompletableDeferred<Integer> ask() {
            CompletableDeferred<Integer> answer = CompletableDeferredKt.CompletableDeferred(null);
            send(new Sum(answer));
            return answer;
        }

        private void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        private void ping(Ping ping) {
            if (ping.hops() == 0) {
                finish.reach();
            } else {
                ping.from().send(new Ping(this, ping.hops() - 1));
            }
        }

        private void begin(AtomicInteger beginners) {
            if (beginners.decrementAndGet() == 0) {
                finish.reach();
            }
        }
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        counter.send(new Expect(messages));
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                counter.send(new Add(i));
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(ChannelFamily.class, scope, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        counter.send(new Ping(other, hops));
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            counter.ask().invokeOnCompletion(failure -> {
                if (left.decrementAndGet() == 0) {
                    finish.reach();
                }
                return Unit.INSTANCE;
            });
        }
        finish.await();
    }

    @Override
    public void askChain(int asks) {
        finish.reset();
        counter.send(new AskInTurn(other, asks));
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            var answer = counter.ask();
            BuildersKt.runBlocking(EmptyCoroutineContext.INSTANCE, (here, caller) -> answer.await(caller));
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = new Counter();
            created.add(newcomer);
            newcomer.send(new Begin(beginners));
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.forEach(Mailbox::stop);
        created.clear();
    }

    @Override
    public void close() {
        thread.shutdownNow();
    }
}
