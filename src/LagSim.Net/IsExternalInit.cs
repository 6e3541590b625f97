#if !NET5_0_OR_GREATER
namespace System.Runtime.CompilerServices;

/// <summary>
/// What compilers ask for to let a property be set while its object is made and never after; .NET Standard 2.1 has it not.
/// </summary>
internal static class IsExternalInit
{
}
#endif
