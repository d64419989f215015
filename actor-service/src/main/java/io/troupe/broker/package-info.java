/**
 * The service registry: finds providers of services, starts them on demand, checks their health, and moves clients to
 * another provider when one fails.
 *
 * <p>Start with {@link io.troupe.broker.Broker}. A service is a {@link io.troupe.broker.Provider}, registered under a
 * name; a client looks it up by a {@link io.troupe.broker.Need}. {@link io.troupe.broker.ActorServices} publishes
 * actors, and connects to them by their interfaces.
 *
 * <p>Inside: {@code BrokerActor} combines the {@code ProviderRegistry} of {@code ManagedProvider}s, which start, check
 * and stop their providers, and the {@code ConnectedClients}. {@code ServiceLink} queues the calls of an
 * {@link io.troupe.broker.ActorConnection} and passes them on to the current provider, a {@code RunningActor} of this
 * process or of another one. Between processes, {@code OfferExchange} makes the providers of the others known to this
 * broker as {@code OfferedProvider}s; {@code RemoteCaller} sends calls, and {@code CallReceiver} receives them.
 */
@NullMarked
package io.troupe.broker;

import org.jspecify.annotations.NullMarked;
