/**
 * The messaging infrastructure between components: publish and subscribe, request and reply.
 *
 * <p>Start with {@link io.troupe.services.bus.InProcessBus} and its {@link io.troupe.services.bus.BusPort}s. A
 * {@link io.troupe.services.bus.BusTopic} names what is published, an {@link io.troupe.services.bus.Operation} what can
 * be requested. A {@link io.troupe.services.bus.BusObserver} is notified of every {@link io.troupe.services.bus.Loss}.
 *
 * <p>Inside: {@code BusNode} routes each {@link io.troupe.services.bus.BusMessage} to the {@code InboundQueue} of a
 * {@code TopicSubscription} or an {@code OperationHandler}, or to {@code PendingRequests}; other nodes are reached over
 * a {@code Transport}.
 */
@NullMarked
package io.troupe.services.bus;

import org.jspecify.annotations.NullMarked;
