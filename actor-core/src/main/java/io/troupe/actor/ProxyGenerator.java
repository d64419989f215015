package io.troupe.actor;

import static org.objectweb.asm.Opcodes.*;

import java.lang.invoke.MethodHandles;
import java.lang.reflect.Method;
import java.util.List;
import org.objectweb.asm.ClassWriter;
import org.objectweb.asm.MethodVisitor;
import org.objectweb.asm.Type;

/**
 * Generates the classes of one actor type in its own package: for each message a class whose typed fields are the
 * arguments, and the proxy, whose methods create and send these messages.
 *
 * <p>For {@code interface Greeter { Promise<String> greet(String name); }} it generates what this would compile to:
 *
 * {@snippet lang = "text":
 * final class Greeter$$greet$0 extends Request<String> {
 *     final String a0;
 *     Greeter$$greet$0(ActorCell cell, String a0) { super(cell); this.a0 = a0; }
 *     protected Node serve() { Object target = target(); return target == null ? null : answer(invoke(target)); }
 *     protected Promise<String> invoke(Object implementation) { return ((Greeter) implementation).greet(a0); }
 * }
 * final class Greeter$$Proxy implements Greeter, ActorProxy {
 *     ActorCell troupe$cell;
 *     public Promise<String> greet(String a0) {
 *         var request = new Greeter$$greet$0(troupe$cell, a0);
 *         troupe$cell.send(request);
 *         return request;
 *     }
 * }
 * }
 */
final class ProxyGenerator {
    static final String CELL = "troupe$cell";
    private static final String CELL_TYPE = Type.getInternalName(ActorCell.class);
    private static final String CALLBACK_DESCRIPTOR = Type.getDescriptor(Callback.class);
    private static final String CELL_DESCRIPTOR = Type.getDescriptor(ActorCell.class);

    private final Class<?> type;
    private final String typeName;
    private final List<Method> messages;
    private final LocalMethods locals;
    private final MethodHandles.Lookup lookup;

    ProxyGenerator(Class<?> type, ActorMethods methods, MethodHandles.Lookup lookup) {
        this.type = type;
        this.typeName = Type.getInternalName(type);
        this.messages = methods.messages();
        this.locals = new LocalMethods(type, typeName + "$$Proxy", methods);
        this.lookup = lookup;
    }

    Class<?> generate() {
        for (int index = 0; index < messages.size(); index++) {
            define(new MessageGenerator(type, messages.get(index), messageName(index)).generate());
        }
        return define(proxy());
    }

    private Class<?> define(byte[] bytes) {
        try {
            return lookup.defineClass(bytes);
        } catch (IllegalAccessException | LinkageError e) {
            throw new ActorTypeException("the proxy of " + type.getName() + " cannot be defined in its package", e);
        }
    }

    /** The number distinguishes overloads, and every message class from the proxy class. */
    private String messageName(int index) {
        return typeName + "$$" + messages.get(index).getName() + "$" + index;
    }

    private byte[] proxy() {
        boolean isInterface = type.isInterface();
        String superName = isInterface ? "java/lang/Object" : typeName;
        String proxyMarker = Type.getInternalName(ActorProxy.class);
        var writer = new ClassWriter(ClassWriter.COMPUTE_MAXS);
        writer.visit(
                V21,
                ACC_FINAL | ACC_SUPER | ACC_SYNTHETIC,
                typeName + "$$Proxy",
                null,
                superName,
                isInterface ? new String[] {typeName, proxyMarker} : new String[] {proxyMarker});
        writer.visitField(isInterface ? ACC_FINAL : 0, CELL, CELL_DESCRIPTOR, null, null)
                .visitEnd();
        if (isInterface) {
            constructor(writer);
        }
        cellAccessor(writer);
        for (int index = 0; index < messages.size(); index++) {
            send(writer, messages.get(index), messageName(index));
        }
        locals.write(writer);
        writer.visitEnd();
        return writer.toByteArray();
    }

    private void constructor(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(0, "<init>", "(" + CELL_DESCRIPTOR + ")V", null, null);
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        code.visitMethodInsn(INVOKESPECIAL, "java/lang/Object", "<init>", "()V", false);
        code.visitVarInsn(ALOAD, 0);
        code.visitVarInsn(ALOAD, 1);
        code.visitFieldInsn(PUTFIELD, typeName + "$$Proxy", CELL, CELL_DESCRIPTOR);
        code.visitInsn(RETURN);
        finish(code);
    }

    private void cellAccessor(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(ACC_PUBLIC, CELL, "()" + CELL_DESCRIPTOR, null, null);
        code.visitCode();
        loadCell(code);
        code.visitInsn(ARETURN);
        finish(code);
    }

    /** Generates {@code new Message(cell, arguments)}, the send, and for a request its return. */
    private void send(ClassWriter writer, Method method, String messageName) {
        boolean oneWay = method.getReturnType() == void.class;
        MethodVisitor code =
                writer.visitMethod(ACC_PUBLIC, method.getName(), Type.getMethodDescriptor(method), null, null);
        code.visitCode();
        loadCell(code);
        code.visitTypeInsn(NEW, messageName);
        code.visitInsn(DUP);
        loadCell(code);
        int local = 1;
        var descriptor = new StringBuilder("(").append(CELL_DESCRIPTOR);
        for (Type argument : Type.getArgumentTypes(method)) {
            if (argument.getDescriptor().equals(CALLBACK_DESCRIPTOR)) {
                loadCell(code);
                code.visitVarInsn(ALOAD, local);
                code.visitMethodInsn(
                        INVOKEVIRTUAL,
                        CELL_TYPE,
                        "returning",
                        "(" + CALLBACK_DESCRIPTOR + ")" + CALLBACK_DESCRIPTOR,
                        false);
            } else {
                code.visitVarInsn(argument.getOpcode(ILOAD), local);
            }
            local += argument.getSize();
            descriptor.append(argument.getDescriptor());
        }
        code.visitMethodInsn(
                INVOKESPECIAL, messageName, "<init>", descriptor.append(")V").toString(), false);
        if (!oneWay) {
            code.visitInsn(DUP_X1); // the stack is now: message, cell, message
        }
        Class<?> parent = oneWay ? Message.class : Request.class;
        code.visitMethodInsn(INVOKEVIRTUAL, CELL_TYPE, "send", "(" + Type.getDescriptor(parent) + ")V", false);
        code.visitInsn(oneWay ? RETURN : ARETURN);
        finish(code);
    }

    private void loadCell(MethodVisitor code) {
        code.visitVarInsn(ALOAD, 0);
        code.visitFieldInsn(GETFIELD, typeName + "$$Proxy", CELL, CELL_DESCRIPTOR);
    }

    private static void finish(MethodVisitor code) {
        code.visitMaxs(0, 0);
        code.visitEnd();
    }
}
