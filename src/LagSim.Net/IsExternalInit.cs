#if !NET5_0_OR_GREATER
namespace System.Runtime.CompilerServices;

/// <summary>Lets the compiler emit init-only properties; .NET Standard 2.1 lacks this type.</summary>
internal static class IsExternalInit
{
}
#endif
