package io.troupe.actor.internal;

import java.lang.reflect.GenericArrayType;
import java.lang.reflect.Method;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.Type;
import java.lang.reflect.TypeVariable;
import java.lang.reflect.WildcardType;
import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * Resolves the type variables of a type's supertypes: {@code put(T)} of a {@code Box<String>} is {@code put(String)}.
 */
public final class TypeArguments {
    private final Map<TypeVariable<?>, Type> arguments = new HashMap<>();

    public TypeArguments(Class<?> type) {
        collectAbove(type);
    }

    private void collectAbove(Class<?> type) {
        collect(type.getGenericSuperclass());
        for (Type parent : type.getGenericInterfaces()) {
            collect(parent);
        }
    }

    private void collect(@Nullable Type parent) {
        if (parent instanceof ParameterizedType generic) {
            note(generic);
            collectAbove((Class<?>) generic.getRawType());
        } else if (parent instanceof Class<?> plain) {
            collectAbove(plain);
        }
    }

    private void note(ParameterizedType generic) {
        TypeVariable<?>[] variables = ((Class<?>) generic.getRawType()).getTypeParameters();
        for (int index = 0; index < variables.length; index++) {
            arguments.put(variables[index], generic.getActualTypeArguments()[index]);
        }
        if (generic.getOwnerType() instanceof ParameterizedType owner) {
            note(owner);
        }
    }

    private record Resolved(Type getRawType, @Nullable Type getOwnerType, List<Type> arguments)
            implements ParameterizedType {
        @Override
        public Type[] getActualTypeArguments() {
            return arguments.toArray(Type[]::new);
        }

        @Override
        public String toString() {
            return getRawType.getTypeName()
                    + arguments.stream().map(Type::getTypeName).collect(Collectors.joining(", ", "<", ">"));
        }
    }

    /** The type with the variables replaced that are known, also among the arguments of a generic type. */
    public Type resolve(Type type) {
        return switch (type) {
            case TypeVariable<?> variable when arguments.containsKey(variable) -> resolve(arguments.get(variable));
            case ParameterizedType generic -> {
                List<Type> resolved = Arrays.stream(generic.getActualTypeArguments())
                        .map(this::resolve)
                        .toList();
                yield resolved.equals(List.of(generic.getActualTypeArguments()))
                        ? generic
                        : new Resolved(generic.getRawType(), generic.getOwnerType(), resolved);
            }
            default -> type;
        };
    }

    /** The classes of a method's parameters, with type variables resolved. */
    public List<? extends Class<?>> parameters(Method method) {
        return Arrays.stream(method.getGenericParameterTypes()).map(this::erase).toList();
    }

    public Class<?> erase(Type type) {
        return switch (type) {
            case Class<?> plain -> plain;
            case ParameterizedType generic -> (Class<?>) generic.getRawType();
            case GenericArrayType array ->
                erase(array.getGenericComponentType()).arrayType();
            case WildcardType wildcard -> erase(wildcard.getUpperBounds()[0]);
            case TypeVariable<?> variable -> {
                Type argument = arguments.get(variable);
                yield erase(argument == null ? variable.getBounds()[0] : argument);
            }
            default -> throw new AssertionError("reflection knows no such type: " + type);
        };
    }

    /**
     * True if the class, or a subtype of it, occurs in the type: as the type itself, as an element or argument, or as a
     * bound.
     */
    public boolean mentions(Type type, Class<?> wanted) {
        return mentions(type, wanted, new HashSet<>());
    }

    private boolean mentions(Type type, Class<?> wanted, Set<Type> seen) {
        if (!seen.add(type)) {
            return false; // a recursive bound, as in T extends Comparable<T>
        }
        return switch (type) {
            case Class<?> array when array.isArray() -> mentions(array.getComponentType(), wanted, seen);
            case Class<?> plain -> wanted.isAssignableFrom(plain);
            case ParameterizedType generic ->
                mentions(generic.getRawType(), wanted, seen) || any(generic.getActualTypeArguments(), wanted, seen);
            case GenericArrayType array -> mentions(array.getGenericComponentType(), wanted, seen);
            case WildcardType wildcard ->
                any(wildcard.getUpperBounds(), wanted, seen) || any(wildcard.getLowerBounds(), wanted, seen);
            case TypeVariable<?> variable -> {
                Type argument = arguments.get(variable);
                yield argument == null ? any(variable.getBounds(), wanted, seen) : mentions(argument, wanted, seen);
            }
            default -> throw new AssertionError("reflection knows no such type: " + type);
        };
    }

    private boolean any(Type[] types, Class<?> wanted, Set<Type> seen) {
        return Arrays.stream(types).anyMatch(type -> mentions(type, wanted, seen));
    }
}
