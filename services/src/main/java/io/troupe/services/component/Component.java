package io.troupe.services.component;

import io.troupe.bus.BusTopic;
import java.util.List;
import java.util.function.Supplier;

/**
 * Description of a component, from which its {@link ComponentInterface} is built: the service that it provides, its
 * topics, its CCU and its DCU.
 *
 * @param service the name of the service
 * @param capabilities further terms by which the broker finds the service
 * @param subscribes the input topics, to which the component subscribes
 * @param publishes the output topics
 * @param communication creates the CCU, once for each run
 * @param conversion the rules of the DCU
 * @param input the DCU's buffer towards the component
 * @param output the DCU's buffer towards the application
 * @param <I> type of the component's input, in the component's format
 * @param <O> type of the component's output, in the component's format
 */
public record Component<I, O>(
        String service,
        List<String> capabilities,
        List<BusTopic<?>> subscribes,
        List<BusTopic<?>> publishes,
        Supplier<? extends ComponentCommunication<I, O>> communication,
        Conversion<I, O> conversion,
        Buffering input,
        Buffering output) {
    public Component {
        capabilities = List.copyOf(capabilities);
        subscribes = List.copyOf(subscribes);
        publishes = List.copyOf(publishes);
    }

    /** A copy with another service name and other capabilities. */
    public Component<I, O> offering(String newService, List<String> newCapabilities) {
        return new Component<>(
                newService, newCapabilities, subscribes, publishes, communication, conversion, input, output);
    }

    /** A copy with other buffers. */
    public Component<I, O> buffered(Buffering newInput, Buffering newOutput) {
        return new Component<>(
                service, capabilities, subscribes, publishes, communication, conversion, newInput, newOutput);
    }
}
