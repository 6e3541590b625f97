using System;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.CompilerServices;

namespace LagSim.Bench;

/// <summary>How much memory an object takes, with all that it alone refers to: counted field by field, so that it can be told part by part.</summary>
internal static class ObjectSize
{
    private const int Header = 16; // of an object; an array's length comes on top
    private const BindingFlags Fields = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

    /// <summary>Bytes of the object and what it refers to, without what was seen already.</summary>
    internal static long Of(object? root, HashSet<object> seen)
    {
        long bytes = 0;
        Stack<object?> left = new();
        left.Push(root);
        while (left.Count > 0)
        {
            object? at = left.Pop();
            if (at is null or Type or Delegate or string or Pointer || !seen.Add(at))
            {
                continue;
            }

            if (at is Array array)
            {
                Type element = array.GetType().GetElementType()!;
                bytes += Header + 8 + (array.Length * (long)SizeOf(element));
                for (int i = 0; i < array.Length && !element.IsValueType; i++)
                {
                    left.Push(array.GetValue(i));
                }

                continue;
            }

            bytes += Header;
            for (Type? type = at.GetType(); type is not null; type = type.BaseType)
            {
                foreach (FieldInfo field in type.GetFields(Fields))
                {
                    bytes += SizeOf(field.FieldType);
                    if (!field.FieldType.IsValueType)
                    {
                        left.Push(field.GetValue(at));
                    }
                }
            }
        }

        return bytes;
    }

    /// <summary>Bytes that a field or an element of the type takes.</summary>
    internal static int SizeOf(Type type) => type.IsValueType
        ? (int)typeof(Unsafe).GetMethod(nameof(Unsafe.SizeOf))!.MakeGenericMethod(type).Invoke(null, null)!
        : IntPtr.Size;
}
